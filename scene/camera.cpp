#include "scene/camera.hpp"

#include "base/error.hpp"
#include "base/rounding.hpp"
#include "base/tangent.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace triptych {

namespace {
bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// The vector scaled to length 1, or 0 for a vector of length 0; squares neither overflow nor vanish on the
/// way.
glm::dvec3 direction(const glm::dvec3& v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return largest > 0 ? glm::normalize(v / largest) : glm::dvec3(0);
}

/// Whether doubles, and later floats, can tell the two sides of the frustum apart.
bool wide_enough(double low, double high) {
  return high - low > 1e-9 * std::max(std::abs(low), std::abs(high)) && std::isfinite(high - low);
}
}  // namespace

void set_field_of_view(Camera& camera, double fov_y_degrees, double aspect) {
  camera.top = tangent(glm::radians(fov_y_degrees) / 2);
  camera.bottom = -camera.top;
  camera.right = camera.top * aspect;
  camera.left = -camera.right;
}

void set_orthographic_height(Camera& camera, double height, double aspect) {
  camera.projection = Projection::orthographic;
  camera.top = height / 2;
  camera.bottom = -camera.top;
  camera.right = camera.top * aspect;
  camera.left = -camera.right;
}

void check_camera(const Camera& camera, const std::string& place) {
  if (!finite(camera.eye) || !finite(camera.target) || !finite(camera.up))
    fail(place, "the camera is not finite");
  const glm::dvec3 forward = camera.target - camera.eye;
  if (forward == glm::dvec3(0) || !finite(forward)) fail(place, "the camera has no direction");
  if (camera.up == glm::dvec3(0)) fail(place, "the camera has no up vector");
  const glm::dvec3 side = glm::cross(direction(forward), direction(camera.up));
  if (!(glm::length(side) > 1e-9)) fail(place, "the camera's up vector lies along its direction");
  for (const double side_tangent : {camera.left, camera.right, camera.bottom, camera.top}) {
    if (!std::isfinite(side_tangent)) fail(place, "the camera's frustum is not finite");
  }
  if (!(camera.left < camera.right) || !(camera.bottom < camera.top))
    fail(place, "the camera's frustum is empty");
  if (!wide_enough(camera.left, camera.right) || !wide_enough(camera.bottom, camera.top))
    fail(place, "the camera's frustum is too thin to be computed");
  if (!(camera.near > 0) || !std::isfinite(camera.near))
    fail(place, "the camera's near plane must be in front of it");
}

namespace {

/// Rows are the eye's axes.
glm::dmat3 rotation_of(const Camera& camera) {
  const glm::dvec3 backward = -direction(camera.target - camera.eye);
  const glm::dvec3 side = glm::normalize(glm::cross(direction(camera.up), backward));
  const glm::dvec3 upward = glm::cross(backward, side);
  return glm::transpose(glm::dmat3(side, upward, backward));
}

}  // namespace

glm::dmat3 View::rotation() const {
  return round_to_nearest([&] { return rotation_of(camera); });
}

double View::focal_length() const { return std::max(focal_x(), focal_y()); }

double View::corner_stretch() const {
  if (camera.orthographic()) return 1;
  const double x = std::max(std::abs(camera.left), std::abs(camera.right));
  const double y = std::max(std::abs(camera.bottom), std::abs(camera.top));
  return std::sqrt(1 + x * x + y * y);
}

}  // namespace triptych
