// A camera, and the view that it gives of a viewport. Everything is double; see docs/algorithms.md for the
// derivations.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <string>

namespace triptych {

/// A perspective camera in model space, right-handed: it looks from eye to target.
struct Camera {
  glm::dvec3 eye{0}, target{0, 0, -1}, up{0, 1, 0};
  /// The frustum's sides at unit distance, as tangents: left, right, bottom, top.
  double left = -1, right = 1, bottom = -1, top = 1;
  /// Distance of the near plane, model units; there is no far plane.
  double near = 0.01;
  bool operator==(const Camera&) const = default;
};

/// A symmetric frustum of the given vertical field of view (degrees) and aspect (width over height).
void set_field_of_view(Camera& camera, double fov_y_degrees, double aspect);

/// Error (place) for a camera without a direction, with numbers that are not finite, an empty frustum or near
/// ≤ 0.
void check_camera(const Camera& camera, const std::string& place);

/// A camera and its viewport in pixels, with what follows from them.
struct View {
  Camera camera;
  int width = 1, height = 1;

  /// Rows are the camera's right, up and backward axes: eye space = rotation · (position − eye). Eye space
  /// looks along −z.
  glm::dmat3 rotation() const;
  /// Pixels per unit of tangent, horizontally and vertically.
  double focal_x() const { return width / (camera.right - camera.left); }
  double focal_y() const { return height / (camera.top - camera.bottom); }
  /// The larger of both: what the pixel error is measured with.
  double focal_length() const;
  /// √(1 + |t|²) at the frustum's corner furthest from the view axis.
  double corner_stretch() const;
  bool operator==(const View&) const = default;
};

}  // namespace triptych
