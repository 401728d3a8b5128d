#include "visibility/silhouette.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>

namespace triptych {

namespace {

/// How far evaluating a half-plane in floats may be off, as a share of the sum of its terms; the graphics
/// card's own rounding included.
constexpr double half_plane_rounding = 0x1p-20;
/// Shorter edges, as a share of the terms of corners, have no direction that rounding leaves alone: corners
/// are off by 2⁻⁵⁰ of those, which moves what is as far away as the terms are large by less than 2⁻²³ of
/// that.
constexpr double min_edge = 0x1p-26;

/// What is found at the four corners of the rectangle.
class Cuts {
 public:
  Cuts(const std::array<glm::dvec2, 8>& corners, const glm::dvec2& margin, double terms)
      : margin_(margin), lo_(corners[0]), hi_(corners[0]) {
    for (const glm::dvec2& corner : corners) {
      lo_ = glm::min(lo_, corner);
      hi_ = glm::max(hi_, corner);
      middle_ += corner / 8.0;
    }
    const glm::dvec2 reach = glm::max(glm::abs(lo_), glm::abs(hi_));
    least_length_ = min_edge * std::max({reach.x, reach.y, terms});
  }

  void add(const glm::dvec2& from, const glm::dvec2& to) {
    const double length = std::abs(to.x - from.x) + std::abs(to.y - from.y);
    if (!(length > least_length_)) return;
    glm::dvec2 normal = glm::dvec2(from.y - to.y, to.x - from.x) / length;
    if (normal.x * (middle_.x - from.x) + normal.y * (middle_.y - from.y) < 0) normal = -normal;
    // Along the rectangle's sides there is nothing to cut.
    if (!(std::abs(normal.x) > 1e-6 && std::abs(normal.y) > 1e-6)) return;
    const double offset = -(normal.x * from.x + normal.y * from.y) + std::abs(normal.x) * margin_.x +
                          std::abs(normal.y) * margin_.y;
    const bool right = normal.x < 0, top = normal.y < 0;  // the corner that is furthest outside
    const double outside = -(normal.x * (right ? hi_.x : lo_.x) + normal.y * (top ? hi_.y : lo_.y) + offset);
    const double cut = outside > 0 ? outside * outside / std::abs(normal.x * normal.y) : 0;
    const size_t corner = (right ? 1u : 0u) + (top ? 2u : 0u);
    if (!(cut > max_cut_[corner])) return;
    max_cut_[corner] = cut;
    const double rounding = half_plane_rounding * (1 + std::abs(offset));
    sides[corner] = {glm::vec2(normal), static_cast<float>(offset + rounding)};
  }

  std::array<HalfPlane, 4> sides;

 private:
  glm::dvec2 margin_, lo_, hi_, middle_{0};
  double least_length_;
  std::array<double, 4> max_cut_{};  ///< twice the area cut off
};

}  // namespace

std::array<HalfPlane, 4> silhouette(const std::array<glm::dvec2, 8>& corners, const FacingSides& facing,
                                    const glm::dvec2& margin, double terms) {
  Cuts cuts(corners, margin, terms);
  for (size_t axis = 0; axis < 3; ++axis) {
    const size_t next = (axis + 1) % 3, last = (axis + 2) % 3;
    for (size_t i = 0; i < 4; ++i) {  // the edges along the axis, by the faces that they are between
      const size_t side_next = i & 1, side_last = i >> 1;
      if (facing[next][side_next] == facing[last][side_last]) continue;
      const size_t from = side_next << next | side_last << last;
      cuts.add(corners[from], corners[from | size_t{1} << axis]);
    }
  }
  return cuts.sides;
}

}  // namespace triptych
