// A camera, and the view that it gives of a viewport. Everything is double; see docs/algorithms.md for the
// derivations.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <string>

namespace triptych {

enum class Projection : uint8_t { perspective, orthographic };

/// A camera in model space, right-handed: it looks from eye to target.
struct Camera {
  glm::dvec3 eye{0}, target{0, 0, -1}, up{0, 1, 0};
  /// The frustum's sides: perspective at unit distance, as tangents; orthographic in model units.
  double left = -1, right = 1, bottom = -1, top = 1;
  /// Distance of the near plane, model units; there is no far plane.
  double near = 0.01;
  Projection projection = Projection::perspective;

  bool orthographic() const { return projection == Projection::orthographic; }
  bool operator==(const Camera&) const = default;
};

/// A symmetric frustum of the given vertical field of view (degrees) and aspect (width over height).
void set_field_of_view(Camera& camera, double fov_y_degrees, double aspect);

/// Orthographic, symmetric: `height` model units from the picture's bottom to its top.
void set_orthographic_height(Camera& camera, double height, double aspect);

/// Error (place) for a camera without a direction, with numbers that are not finite, a frustum that is empty
/// or too thin for doubles, or near ≤ 0.
void check_camera(const Camera& camera, const std::string& place);

/// A camera and its viewport in pixels, with what follows from them.
struct View {
  Camera camera;
  int width = 1, height = 1;

  /// Rows are the camera's right, up and backward axes: eye space = rotation · (position − eye). Eye space
  /// looks along −z.
  glm::dmat3 rotation() const;
  /// Pixels per unit of tangent (orthographic: per model unit), horizontally and vertically.
  double focal_x() const { return width / (camera.right - camera.left); }
  double focal_y() const { return height / (camera.top - camera.bottom); }
  /// The larger of the two: what the pixel error is measured with.
  double focal_length() const;
  /// √(1 + |t|²) at the frustum's corner furthest from the view axis; orthographic: 1.
  double corner_stretch() const;
  bool operator==(const View&) const = default;
};

}  // namespace triptych
