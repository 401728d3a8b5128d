#include "raster/edge_marker.hpp"

#include <algorithm>

namespace triptych {

EdgeMarker::EdgeMarker(const VisibilityBuffer& plane, const EdgeRule& rule, const SamplePlace& place)
    : plane_(&plane),
      rule_(&rule),
      centre_(glm::vec2(0.5 + place.pixels())),
      below_(static_cast<size_t>(plane.width())),
      above_(below_),
      normals_(count) {
  // No slot that is looked for in an entry has this number.
  for (uint32_t i = 0; i < count; ++i) normals_[i].slot = i + 1;
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
  // One triangle has no edges within; most pairs are of one.
  if (something == other && (!something || plane_->slots(y)[i] == plane_->slots(other_y)[k]))
    return EdgeOwner::none;
  return rule_->between(point(x, y), at(x, y), point(other_x, other_y), at(other_x, other_y));
}

SurfacePoint EdgeMarker::point(int32_t x, int32_t y) {
  const float depth = plane_->depth(x, y);
  if (depth == 0) return {};
  const uint32_t slot = plane_->slots(y)[static_cast<size_t>(x)];
  Normal& normal = normals_[slot % count];
  if (normal.slot != slot) normal = {slot, TriangleShader::normal(plane_->find(slot))};
  return {depth, normal.of};
}

glm::vec2 EdgeMarker::at(int32_t x, int32_t y) const {
  return {static_cast<float>(x) + centre_.x, static_cast<float>(y) + centre_.y};
}

}  // namespace triptych
