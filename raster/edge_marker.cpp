#include "raster/edge_marker.hpp"

#include <algorithm>

namespace triptych {

EdgeMarker::EdgeMarker(const VisibilityBuffer& plane, const FrameView& view, const EdgeRule& rule,
                       const SamplePlace& place)
    : plane_(&plane),
      rule_(&rule),
      caps_(view, place),
      centre_(glm::vec2(0.5 + place.pixels())),
      below_(static_cast<size_t>(plane.width())),
      above_(below_),
      faces_(count) {
  // No slot that is looked for in an entry has this number.
  for (uint32_t i = 0; i < count; ++i) faces_[i].slot = i + 1;
}

[[gnu::noinline]] void EdgeMarker::draw(int32_t y, Rgba* row) {
  if (y != next_row_) compare_upwards(y - 1, below_);
  compare_upwards(y, above_);
  const int32_t width = plane_->width();
  EdgeOwner left = EdgeOwner::none;  // between the pixel and the one to its left
  for (int32_t x = 0; x < width; ++x) {
    const EdgeOwner right = x + 1 < width ? between(x, y, x + 1, y) : EdgeOwner::none;
    const auto i = static_cast<size_t>(x);
    if (left == EdgeOwner::second || right == EdgeOwner::first || below_[i] == EdgeOwner::second ||
        above_[i] == EdgeOwner::first)
      row[x] = edge_bytes;
    left = right;
  }
  std::swap(below_, above_);
  next_row_ = y + 1;
}

void EdgeMarker::compare_upwards(int32_t y, std::vector<EdgeOwner>& owners) {
  if (y < 0 || y + 1 >= plane_->height()) {
    std::ranges::fill(owners, EdgeOwner::none);
    return;
  }
  for (int32_t x = 0; x < plane_->width(); ++x) owners[static_cast<size_t>(x)] = between(x, y, x, y + 1);
}

EdgeOwner EdgeMarker::between(int32_t x, int32_t y, int32_t other_x, int32_t other_y) {
  const auto i = static_cast<size_t>(x), k = static_cast<size_t>(other_x);
  const bool something = plane_->depths(y)[i] != 0, other = plane_->depths(other_y)[k] != 0;
  if (!something && !other) return EdgeOwner::none;
  // One triangle has no edges within, but where caps of several sides show in its place; most pairs are of
  // one.
  const uint32_t slot = plane_->slots(y)[i];
  if (something && other && slot == plane_->slots(other_y)[k] && !face(slot).capped) return EdgeOwner::none;
  return rule_->between(point(x, y), at(x, y), point(other_x, other_y), at(other_x, other_y));
}

const EdgeMarker::Face& EdgeMarker::face(uint32_t slot) {
  Face& face = faces_[slot % count];
  if (face.slot != slot) {
    const SlotTable::Triangle shown = plane_->find(slot);
    face = {slot, TriangleShader::normal(shown), Caps::show(shown)};
  }
  return face;
}

SurfacePoint EdgeMarker::point(int32_t x, int32_t y) {
  const float depth = plane_->depth(x, y);
  if (depth == 0) return {};
  const Face& seen = face(plane_->slots(y)[static_cast<size_t>(x)]);
  if (seen.capped) {
    if (const auto cap = caps_.entry(x, y)) return {cap->depth, caps_.normal(cap->side)};
  }
  return {depth, seen.normal};
}

glm::vec2 EdgeMarker::at(int32_t x, int32_t y) const {
  return {static_cast<float>(x) + centre_.x, static_cast<float>(y) + centre_.y};
}

}  // namespace triptych
