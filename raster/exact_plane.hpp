// The depth of a triangle's plane as it is, not as the snapped corners have it.
#pragma once

#include "raster/window.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace triptych {

/// Triangles of different shapes that lie in one plane get the same depths from it, but for rounding: they
/// could not, if their corners had moved to sub-pixels first.
class ExactPlane {
 public:
  ExactPlane() = default;
  /// Of corners in clip space, wherever they lie.
  ExactPlane(const std::array<glm::dvec4, 3>& corners, const WindowTransform& window)
      : scale_x_(window.scale_x()),
        scale_y_(window.scale_y()),
        middle_x_(window.middle_x()),
        middle_y_(window.middle_y()) {
    // depth = z / w is affine over x / w and y / w: slopes · (x, y, w) = z at each corner, by Cramer's rule.
    const auto rest = [&](size_t k) { return glm::dvec3(corners[k].x, corners[k].y, corners[k].w); };
    const glm::dvec3 a = rest(0), b = rest(1), c = rest(2);
    const glm::dvec3 bc = glm::cross(b, c), ca = glm::cross(c, a), ab = glm::cross(a, b);
    slopes_ = (bc * corners[0].z + ca * corners[1].z + ab * corners[2].z) / glm::dot(a, bc);
  }

  /// At the snapped corner; what the corner has already, where the plane is seen so nearly edge-on that this
  /// is no better.
  float depth_at(const WindowVertex& corner) const {
    const double x = (corner.x - middle_x_) / scale_x_, y = (corner.y - middle_y_) / scale_y_;
    const double depth = (slopes_.x * x + slopes_.y * y) + slopes_.z;
    constexpr double most = 1.0 / 4;
    return std::abs(depth - corner.depth) <= most * corner.depth ? static_cast<float>(depth) : corner.depth;
  }

 private:
  glm::dvec3 slopes_{0};
  double scale_x_ = 1, scale_y_ = 1, middle_x_ = 0, middle_y_ = 0;
};

}  // namespace triptych
