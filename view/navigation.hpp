// How a person moves through a model: camera state and what input does to it. Pure; no window.
#pragma once

#include "scene/box.hpp"
#include "scene/camera.hpp"

#include <glm/vec3.hpp>
#include <limits>

namespace triptych {

/// A person's input between two pictures.
struct WalkerMotion {
  /// Held directions, −1 to 1: along the line of sight, to the right, along the walker's up axis.
  double forward = 0, right = 0, up = 0;
  /// Mouse movement while looking around, in window pixels: rightwards and downwards.
  double turn_right = 0, turn_down = 0;
  /// Steps by which walking gets faster.
  double faster = 0;
  bool operator==(const WalkerMotion&) const = default;
};

/// Where a person looks from at a whole model: at its front, so along −z where y is up, and so on.
enum class Side { front, right, top };

/// A person's eye in model space. The horizon never tilts.
class Walker {
 public:
  /// Stands where the camera stands and looks where it looks, with its projection and height; `reach` is the
  /// model's diagonal, model units: the initial speed is a tenth of it per second.
  Walker(const Camera& camera, double reach);
  /// A walker outside the box, with all of it in sight; y is up.
  static Walker before(const Box& box, double near);

  /// Moves and turns for so many seconds; a picture is `window_height` pixels high, and the point under the
  /// mouse stays there while looking around.
  void move(const WalkerMotion& motion, double seconds, int window_height);
  /// Stands where the camera stands; the speed stays.
  void jump_to(const Camera& camera);

  /// Turns about a point, which stays where it is on the screen, by so many pixels of the mouse: all round
  /// for twice the window's height.
  void orbit(const glm::dvec3& point, double right, double down, int window_height);
  /// Moves across the line of sight, so that what is as deep as the point follows the mouse, window pixels.
  void pan(const glm::dvec3& point, double right, double down, int window_height);
  /// Comes nearer to a point, by a fifth of the way a step, or goes away from it; it stays where it is on the
  /// screen. Orthographic: everything gets larger.
  void zoom(const glm::dvec3& point, double steps);
  /// Goes back, or forward, along the line of sight until the box fits, with some room around it. aspect:
  /// width over height. most: no further from its middle than that, if that is still outside of the box: then
  /// not all of it is in sight.
  void frame(const Box& box, double aspect, double most = std::numeric_limits<double>::infinity());
  /// Turns on the spot, radians.
  void turn(double right, double up);
  /// Turns to look at that side.
  void look_at(Side side);
  /// Between a perspective and an orthographic picture in which what is as deep as the point stays as large.
  /// stays: does not go back for an orthographic one, so that what is behind the eye does not come before it.
  void switch_projection(const glm::dvec3& point, bool stays);
  /// From now on a second takes the walker as far as that times its pace: what it looks at is so far away.
  void see(double distance);

  View view(int width, int height) const;
  glm::dvec3 direction() const;        ///< of sight, unit length
  glm::dvec3 level_direction() const;  ///< the same without its part along the up axis, unit length
  const glm::dvec3& eye() const { return eye_; }
  const glm::dvec3& up() const { return up_; }
  bool orthographic() const { return projection_ == Projection::orthographic; }
  double pace() const { return pace_; }
  void set_pace(double pace) { pace_ = pace; }    ///< positive
  double speed() const { return pace_ * seen_; }  ///< model units a second
  double seen() const { return seen_; }           ///< what see() was told last, model units

 private:
  glm::dvec3 right() const;
  glm::dvec3 picture_up() const;
  double depth_of(const glm::dvec3& point) const;
  /// Model units a pixel at that depth.
  double units_a_pixel(double depth, int window_height) const;

  glm::dvec3 eye_{0}, up_{0, 1, 0}, north_{0, 0, -1};  ///< up and north: unit, at right angles
  double heading_ = 0, pitch_ = 0;                     ///< radians; from north to the right, and upwards
  Projection projection_ = Projection::perspective;
  double half_height_ = 1;       ///< of the frustum: at unit distance; orthographic: in model units
  double half_height_at_1_ = 1;  ///< that of the last perspective picture
  double near_ = 0.01, reach_ = 1, seen_ = 1, pace_ = 1;
};

}  // namespace triptych
