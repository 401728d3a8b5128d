#include "scene/camera.hpp"

#include "base/error.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace triptych {

namespace {
bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
}  // namespace

void set_field_of_view(Camera& camera, double fov_y_degrees, double aspect) {
  camera.top = std::tan(glm::radians(fov_y_degrees) / 2);
  camera.bottom = -camera.top;
  camera.right = camera.top * aspect;
  camera.left = -camera.right;
}

void check_camera(const Camera& camera, const std::string& place) {
  if (!finite(camera.eye) || !finite(camera.target) || !finite(camera.up))
    fail(place, "the camera is not finite");
  const glm::dvec3 forward = camera.target - camera.eye;
  if (!(glm::length(forward) > 0) || !std::isfinite(glm::length(forward)))
    fail(place, "the camera has no direction");
  if (!(glm::length(camera.up) > 0)) fail(place, "the camera has no up vector");
  const glm::dvec3 side = glm::cross(glm::normalize(forward), glm::normalize(camera.up));
  if (!(glm::length(side) > 1e-9)) fail(place, "the camera's up vector lies along its direction");
  for (const double side_tangent : {camera.left, camera.right, camera.bottom, camera.top}) {
    if (!std::isfinite(side_tangent)) fail(place, "the camera's frustum is not finite");
  }
  if (!(camera.left < camera.right) || !(camera.bottom < camera.top))
    fail(place, "the camera's frustum is empty");
  if (!(camera.near > 0) || !std::isfinite(camera.near))
    fail(place, "the camera's near plane must be in front of it");
}

glm::dmat3 View::rotation() const {
  const glm::dvec3 backward = -glm::normalize(camera.target - camera.eye);
  const glm::dvec3 side = glm::normalize(glm::cross(glm::normalize(camera.up), backward));
  const glm::dvec3 upward = glm::cross(backward, side);
  return glm::transpose(glm::dmat3(side, upward, backward));
}

double View::focal_length() const { return std::max(focal_x(), focal_y()); }

double View::corner_stretch() const {
  const double x = std::max(std::abs(camera.left), std::abs(camera.right));
  const double y = std::max(std::abs(camera.bottom), std::abs(camera.top));
  return std::sqrt(1 + x * x + y * y);
}

}  // namespace triptych
