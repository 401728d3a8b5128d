#include "visibility/screen_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/matrix.hpp>

namespace triptych {

ScreenLines::ScreenLines(const View& view) : view_(view), rotation_(view.rotation()) {}

glm::vec4 ScreenLines::project(const glm::dvec3& position) const {
  const Camera& camera = view_.camera;
  const double width = camera.right - camera.left, height = camera.top - camera.bottom;
  const glm::dvec3 eye = rotation_ * (position - camera.eye);
  if (camera.orthographic()) {  // z: how far behind the near plane
    return glm::vec4((2 * eye.x - (camera.right + camera.left)) / width,
                     (2 * eye.y - (camera.top + camera.bottom)) / height, -eye.z - camera.near, 1);
  }
  return glm::vec4((2 * eye.x + (camera.right + camera.left) * eye.z) / width,
                   (2 * eye.y + (camera.top + camera.bottom) * eye.z) / height, camera.near, -eye.z);
}

void ScreenLines::add_line(const glm::dvec3& from, const glm::dvec3& to, const glm::vec4& color) {
  ScreenLine line{project(from), project(to), color};
  if (view_.camera.orthographic()) {
    // What is drawn has 0 <= z <= w: 1 in the near plane, and less behind it, up to the line's farther end.
    const float reach = std::max({std::abs(line.from.z), std::abs(line.to.z), 1e-30f});
    for (float* z : {&line.from.z, &line.to.z}) *z = 1 - *z / reach;
  }
  lines_.push_back(line);
}

void ScreenLines::add_box(const Box& box, const glm::vec4& color) {
  for (int corner = 0; corner < 8; ++corner) {
    for (const int axis : {1, 2, 4}) {
      if ((corner & axis) == 0) add_line(box.corner(corner), box.corner(corner | axis), color);
    }
  }
}

void ScreenLines::add_frustum(const View& view, double depth, const glm::vec4& color) {
  const Camera& camera = view.camera;
  const glm::dmat3 to_model = glm::transpose(view.rotation());
  const auto at = [&](double x, double y, double distance) {
    const double spread = camera.orthographic() ? 1 : distance;
    return camera.eye + to_model * glm::dvec3(x * spread, y * spread, -distance);
  };
  const std::array<glm::dvec2, 4> sides = {glm::dvec2(camera.left, camera.bottom),
                                           {camera.right, camera.bottom},
                                           {camera.right, camera.top},
                                           {camera.left, camera.top}};
  for (size_t i = 0; i < sides.size(); ++i) {
    const glm::dvec2 here = sides[i], next = sides[(i + 1) % sides.size()];
    add_line(at(here.x, here.y, 0), at(here.x, here.y, depth), color);
    add_line(at(here.x, here.y, depth), at(next.x, next.y, depth), color);
  }
}

}  // namespace triptych
