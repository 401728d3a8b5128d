// How a person moves through a model: camera state and what input does to it. Pure; no window.
#pragma once

#include "scene/box.hpp"
#include "scene/camera.hpp"

#include <glm/vec3.hpp>

namespace triptych {

/// A person's input between two pictures.
struct Motion {
  /// Held directions, −1 to 1: along the line of sight, to the right, along the walker's up axis.
  double forward = 0, right = 0, up = 0;
  /// Mouse movement while looking around, in window pixels: rightwards and downwards.
  double turn_right = 0, turn_down = 0;
  /// Wheel clicks; away from the person is faster.
  double wheel = 0;
  bool operator==(const Motion&) const = default;
};

/// A person's eye in model space. The up axis never tilts; looking straight up or down stops just before it.
class Walker {
 public:
  /// Stands where the camera stands and looks where it looks, with its projection and height; `reach` is the
  /// model's diagonal, model units: the initial speed is a tenth of it per second.
  Walker(const Camera& camera, double reach);
  /// A walker outside the box, with all of it in sight; y is up.
  static Walker before(const Box& box, double near);

  /// Moves and turns for so many seconds; a picture is `window_height` pixels high, and the point under the
  /// mouse stays there while looking around.
  void move(const Motion& motion, double seconds, int window_height);
  /// Stands where the camera stands; the speed stays.
  void jump_to(const Camera& camera);

  View view(int width, int height) const;
  glm::dvec3 direction() const;        ///< of sight, unit length
  glm::dvec3 level_direction() const;  ///< the same without its part along the up axis, unit length
  const glm::dvec3& eye() const { return eye_; }
  const glm::dvec3& up() const { return up_; }
  double speed() const { return speed_; }  ///< model units a second

 private:
  glm::dvec3 eye_{0}, up_{0, 1, 0}, north_{0, 0, -1};  ///< up and north: unit, at right angles
  double heading_ = 0, pitch_ = 0;                     ///< radians; from north to the right, and upwards
  Projection projection_ = Projection::perspective;
  double half_height_ = 1;  ///< of the frustum: at unit distance; orthographic: in model units
  double near_ = 0.01, reach_ = 1, speed_ = 1;
};

}  // namespace triptych
