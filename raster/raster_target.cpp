#include "raster/raster_target.hpp"

#include "base/error.hpp"
#include "base/threads.hpp"
#include "raster/box_test.hpp"
#include "raster/float_state.hpp"
#include "raster/lines.hpp"
#include "raster/resolve.hpp"
#include "visibility/facing.hpp"
#include "visibility/sample_rectangle.hpp"
#include "visibility/shading.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace triptych {

RasterScene::RasterScene(const Skeleton& skeleton, Representation& representation, Residency& residency)
    : skeleton_(skeleton),
      representation_(representation),
      geometry_(skeleton, residency),
      placer_(skeleton),
      cut_bodies_(skeleton),
      everywhere_(max_chunk_pieces,
                  skeleton.scene_nodes.empty() ? LatticeBox() : skeleton.scene_nodes[0].box) {}

[[gnu::noinline]] void RasterScene::set_view(const FrameView& view) {
  // A changed cap holds for a camera that rests, too.
  const bool same = view_ && view.state == view_->state && view.rules == view_->rules;
  if (same && !std::exchange(cap_changed_, false)) return;
  view_ = view;
  geometry_.begin_view();
  representation_.begin(view);
  placer_.begin(view);
  projector_.emplace(view, steady_margins);
  terms_.clear();
  for (const SamplePlace& place : sample_places(view.state.samples))
    terms_.emplace_back(*view_, *projector_, place);
}

[[gnu::noinline]] uint64_t RasterScene::draw(std::span<const DrawableId> drawables, SamplePlanes& planes) {
  assert(planes.size() == terms_.size());
  // Front to back, so that tiles hide what comes later; the result is the same in any order.
  ranks_.clear();
  for (const DrawableId id : drawables) ranks_.push_back(draw_rank(skeleton_, view_->cell, id));
  std::sort(ranks_.begin(), ranks_.end());
  items_.clear();
  for (const DrawRank& rank : ranks_) representation_.append(rank.id, items_);
  geometry_.require(items_);
  cut_bodies_.find(*view_, items_);
  for (const CutRun& run : cut_bodies_.runs()) geometry_.require(run.chunk);
  stretches_.clear();
  names_.clear();
  uint64_t triangles = 0;
  auto rank = ranks_.begin();
  for (const DrawItem& item : items_) {
    const bool same = !names_.empty() && names_.back().rank.id == item.drawable;
    while (rank->id != item.drawable) ++rank;
    names_.push_back({*rank, same ? names_.back().part + 1 : 0});
    const RasterChunk* const chunk = geometry_.chunk(item.chunk);
    if (chunk == nullptr) continue;
    const SectionPlace place = view_->section_place(item.pieces);
    if (place.outside) continue;
    PlacedStretch stretch{.rank = names_.back().rank,
                          .part = names_.back().part,
                          .chunk = chunk,
                          .first_triangle = item.first_index / 3,
                          .triangle_count = item.index_count / 3,
                          .placed = placer_.place(item.transform, skeleton_.chunks[item.chunk].lattice),
                          .front = 0,
                          .cut = place.cut,
                          .pieces = item.pieces};
    if (stretch.chunk->has_outward)
      stretch.front = outward_front(*view_, skeleton_.transforms[item.transform], item.pieces);
    triangles += stretch.triangle_count;
    stretches_.push_back(stretch);
  }
  add_cap_runs();
  for (size_t i = 0; i < planes.size(); ++i) {
    planes[i].draw(terms_[i], stretches_);
    planes[i].draw_caps(terms_[i], cap_runs_, cap_counters_);
  }
  return triangles;
}

void RasterScene::add_cap_runs() {
  cap_runs_.clear();
  for (const CutBody& body : cut_bodies_.all()) {
    const std::span<const CutRun> runs = cut_bodies_.runs_of(body);
    // A surface of which a part is still to be read has no winding numbers.
    if (std::ranges::any_of(runs, [&](const CutRun& run) { return geometry_.chunk(run.chunk) == nullptr; }))
      continue;
    for (size_t i = 0; i < runs.size(); ++i) {
      const CutRun& run = runs[i];
      const bool drawn = run.item != no_id;
      const Name name = drawn ? names_[run.item] : Name();
      cap_runs_.push_back({{.rank = name.rank,
                            .part = name.part,
                            .chunk = geometry_.chunk(run.chunk),
                            .first_triangle = run.first_triangle,
                            .triangle_count = run.triangle_count,
                            .placed = placer_.place(body.transform, skeleton_.chunks[run.chunk].lattice),
                            .front = 0,
                            .cut = body.cut,
                            .pieces = drawn ? items_[run.item].pieces : everywhere(run.chunk)},
                           drawn,
                           i == 0,
                           i + 1 == runs.size()});
    }
  }
}

RasterTarget::RasterTarget(RasterScene& scene, TargetKind kind, int width, int height,
                           const RasterOptions& options)
    : scene_(scene), kind_(kind), max_slots_(options.max_slots), drawn_(scene.skeleton().drawables.size()) {
  make_planes(1, width, height);
}

void RasterTarget::make_planes(size_t count, int width, int height) {
  while (planes_.size() > count) planes_.pop_back();
  while (planes_.size() < count)
    planes_.emplace_back(width, height, kind_ == TargetKind::depth_only, max_slots_);
}

DeviceMargins RasterTarget::margins() const { return steady_margins; }

void RasterTarget::begin(const FrameView& view) {
  if (view.view().width != width() || view.view().height != height()) {
    fail("frame target", "a viewport of {}x{} where {}x{} was agreed", view.view().width, view.view().height,
         width(), height());
  }
  const FloatState state;
  view_ = view;
  scene_.set_view(view);
  make_planes(view.state.samples, width(), height());
  for (VisibilityBuffer& plane : planes_) plane.clear();
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
  drawn_triangles_ += scene_.draw(fresh_, planes_);
  picture_is_made_ = false;
}

void RasterTarget::test(std::span<const ScreenRectangle> rectangles, std::span<const uint32_t> ends,
                        uint32_t min_pixels, std::span<uint8_t> visible) {
  const bool strict = !view_->rules.non_strict_test;
  const auto places = sample_places(view_->state.samples);
  const auto count = [&](size_t plane, const ScreenRectangle& rectangle, uint32_t enough) {
    return planes_.size() == 1
               ? count_pixels(planes_[plane], rectangle, strict, enough)
               : count_pixels(planes_[plane], at_sample(rectangle, places[plane], width(), height()), strict,
                              enough);
  };
  const auto test_some = [&](size_t begin, size_t end) {
    const FloatState state;
    for (size_t i = begin; i < end; ++i) {
      const size_t first = i == 0 ? 0 : ends[i - 1];
      const auto own = rectangles.subspan(first, ends[i] - first);
      visible[i] = 0;
      for (size_t plane = 0; plane < planes_.size() && visible[i] == 0; ++plane) {
        uint32_t missing = min_pixels;
        for (auto next = own.begin(); next != own.end() && missing > 0; ++next)
          missing -= count(plane, *next, missing);
        visible[i] = missing == 0;
      }
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
  const bool strict = !view_->rules.non_strict_test;
  const auto places = sample_places(view_->state.samples);
  for (size_t i = 0; i < planes_.size(); ++i) {
    const ScreenExtent seen = planes_.size() == 1 ? extent : at_sample(extent, places[i], width(), height());
    if (!triptych::hides(planes_[i], seen, strict)) return false;
  }
  return true;
}

void RasterTarget::finish() {
  if (has_colors()) make_picture();
}

void RasterTarget::make_picture() const {
  if (picture_is_made_) return;
  const FloatState state;
  picture_.resize(static_cast<size_t>(width()) * static_cast<size_t>(height()));
  if (!view_) {
    std::fill(picture_.begin(), picture_.end(), background_bytes);
  } else if (planes_.size() == 1 && !view_->state.edges) {
    shade(planes_.front(), *view_, picture_);
  } else {
    resolve(planes_, *view_, picture_);
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

std::vector<uint32_t> RasterTarget::read_items(uint32_t sample) const {
  assert(kind_ == TargetKind::item || kind_ == TargetKind::color_and_item);
  std::vector<uint32_t> items(static_cast<size_t>(width()) * static_cast<size_t>(height()));
  name_items(planes_[sample], items);
  return items;
}

}  // namespace triptych
