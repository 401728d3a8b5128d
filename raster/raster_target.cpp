#include "raster/raster_target.hpp"

#include "base/error.hpp"
#include "base/threads.hpp"
#include "raster/box_test.hpp"
#include "raster/float_state.hpp"
#include "raster/lines.hpp"
#include "visibility/facing.hpp"
#include "visibility/shading.hpp"

#include <algorithm>
#include <cassert>

namespace triptych {

RasterScene::RasterScene(const Skeleton& skeleton, Representation& representation, Residency& residency)
    : skeleton_(skeleton),
      representation_(representation),
      geometry_(skeleton, residency),
      placer_(skeleton) {}

[[gnu::noinline]] void RasterScene::set_view(const FrameView& view) {
  if (view_ && view.state == view_->state && view.rules == view_->rules) return;
  view_ = view;
  representation_.begin(view);
  placer_.begin(view);
  projector_.emplace(view, steady_margins);
  terms_.emplace(*view_, *projector_);
}

[[gnu::noinline]] uint64_t RasterScene::draw(std::span<const DrawableId> drawables,
                                             VisibilityBuffer& buffer) {
  // Front to back, so that tiles hide what comes later; the result is the same in any order.
  ranks_.clear();
  for (const DrawableId id : drawables) ranks_.push_back(draw_rank(skeleton_, view_->cell, id));
  std::sort(ranks_.begin(), ranks_.end());
  items_.clear();
  for (const DrawRank& rank : ranks_) representation_.append(rank.id, items_);
  geometry_.require(items_);
  stretches_.clear();
  uint64_t triangles = 0;
  auto rank = ranks_.begin();
  for (const DrawItem& item : items_) {
    const bool same = !stretches_.empty() && stretches_.back().rank.id == item.drawable;
    while (rank->id != item.drawable) ++rank;
    PlacedStretch stretch{.rank = *rank,
                          .part = same ? stretches_.back().part + 1 : 0,
                          .chunk = &geometry_.chunk(item.chunk),
                          .first_triangle = item.first_index / 3,
                          .triangle_count = item.index_count / 3,
                          .placed = placer_.place(item.transform, skeleton_.chunks[item.chunk].lattice),
                          .front = 0,
                          .pieces = item.pieces};
    if (stretch.chunk->has_outward)
      stretch.front = outward_front(*view_, skeleton_.transforms[item.transform], item.pieces);
    triangles += stretch.triangle_count;
    stretches_.push_back(stretch);
  }
  buffer.draw(*terms_, stretches_);
  return triangles;
}

RasterTarget::RasterTarget(RasterScene& scene, TargetKind kind, int width, int height,
                           const RasterOptions& options)
    : scene_(scene),
      kind_(kind),
      buffer_(width, height, kind == TargetKind::depth_only, options.max_slots),
      drawn_(scene.skeleton().drawables.size()) {}

DeviceMargins RasterTarget::margins() const { return steady_margins; }

void RasterTarget::begin(const FrameView& view) {
  if (view.view().width != width() || view.view().height != height()) {
    fail("frame target", "a viewport of {}x{} where {}x{} was agreed", view.view().width, view.view().height,
         width(), height());
  }
  const FloatState state;
  view_ = view;
  scene_.set_view(view);
  buffer_.clear();
  drawn_.clear();
  drawn_triangles_ = 0;
  picture_is_made_ = false;
}

void RasterTarget::draw(std::span<const DrawableId> drawables) {
  const FloatState state;
  fresh_.clear();
  for (const DrawableId id : drawables) {
    if (drawn_.mark_first(id)) fresh_.push_back(id);
  }
  if (fresh_.empty()) return;
  scene_.set_view(*view_);  // other targets draw, too
  drawn_triangles_ += scene_.draw(fresh_, buffer_);
  picture_is_made_ = false;
}

void RasterTarget::test(std::span<const ScreenRectangle> rectangles, std::span<const uint32_t> ends,
                        uint32_t min_pixels, std::span<uint8_t> visible) {
  const bool strict = !view_->rules.non_strict_test;
  const auto test_some = [&](size_t begin, size_t end) {
    const FloatState state;
    for (size_t i = begin; i < end; ++i) {
      const size_t first = i == 0 ? 0 : ends[i - 1];
      const auto own = rectangles.subspan(first, ends[i] - first);
      uint32_t missing = min_pixels;
      for (auto next = own.begin(); next != own.end() && missing > 0; ++next)
        missing -= count_pixels(buffer_, *next, strict, missing);
      visible[i] = missing == 0;
    }
  };
  // Few tests take less time than waking other threads.
  constexpr size_t worth_sharing = 128, share = 32;
  if (ends.size() >= worth_sharing) {
    parallel_for((ends.size() + share - 1) / share,
                 [&](size_t i) { test_some(i * share, std::min((i + 1) * share, ends.size())); });
  } else {
    test_some(0, ends.size());
  }
}

bool RasterTarget::hides(const ScreenExtent& extent) const {
  return triptych::hides(buffer_, extent, !view_->rules.non_strict_test);
}

void RasterTarget::finish() {
  if (has_colors()) make_picture();
}

void RasterTarget::make_picture() const {
  if (picture_is_made_) return;
  const FloatState state;
  picture_.resize(static_cast<size_t>(width()) * static_cast<size_t>(height()));
  if (view_) {
    shade(buffer_, *view_, picture_);
  } else {
    std::fill(picture_.begin(), picture_.end(), background_bytes);
  }
  picture_is_made_ = true;
}

void RasterTarget::draw_lines(std::span<const ScreenLine> lines) {
  make_picture();
  triptych::draw_lines(lines, width(), height(), picture_);
}

std::span<const uint8_t> RasterTarget::colors_in_memory() const {
  assert(has_colors());
  make_picture();
  return {reinterpret_cast<const uint8_t*>(picture_.data()), picture_.size() * sizeof(Rgba)};
}

std::vector<uint8_t> RasterTarget::read_colors() const {
  const std::span<const uint8_t> colors = colors_in_memory();
  return {colors.begin(), colors.end()};
}

std::vector<uint32_t> RasterTarget::read_items() const {
  assert(kind_ == TargetKind::item || kind_ == TargetKind::color_and_item);
  std::vector<uint32_t> items(static_cast<size_t>(width()) * static_cast<size_t>(height()));
  name_items(buffer_, items);
  return items;
}

}  // namespace triptych
