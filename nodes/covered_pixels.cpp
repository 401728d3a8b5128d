#include "nodes/covered_pixels.hpp"

#include <algorithm>
#include <limits>

namespace triptych {

void CoveredPixels::begin(const FrameView& view) {
  const Camera& camera = view.view().camera;
  eye_ = camera.eye;
  for (int axis = 0; axis < 3; ++axis) axes_[static_cast<size_t>(axis)] = view.rotation[axis];
  left_ = camera.left, right_ = camera.right, bottom_ = camera.bottom, top_ = camera.top;
  near_ = camera.near;
  parallel_ = camera.orthographic();
  pixels_a_square_ = view.view().width / (right_ - left_) * view.view().height / (top_ - bottom_);
}

double CoveredPixels::by(const LatticeBox& box) const {
  const Box placed = lattice_.box(box);
  const glm::dvec3 size = placed.hi - placed.lo, from = placed.lo - eye_;
  const glm::dvec3 corner = from.x * axes_[0] + from.y * axes_[1] + from.z * axes_[2];
  const std::array sides = {size.x * axes_[0], size.y * axes_[1], size.z * axes_[2]};
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double left = infinity, right = -infinity, bottom = infinity, top = -infinity;
  for (unsigned i = 0; i < 8; ++i) {
    glm::dvec3 at = corner;
    for (unsigned axis = 0; axis < 3; ++axis)
      if ((i >> axis & 1) != 0) at += sides[axis];
    const double depth = parallel_ ? 1 : std::max(-at.z, near_);
    left = std::min(left, at.x / depth), right = std::max(right, at.x / depth);
    bottom = std::min(bottom, at.y / depth), top = std::max(top, at.y / depth);
  }
  const double width = std::min(right, right_) - std::max(left, left_);
  const double height = std::min(top, top_) - std::max(bottom, bottom_);
  return width > 0 && height > 0 ? width * height * pixels_a_square_ : 0;
}

}  // namespace triptych
