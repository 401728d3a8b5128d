#include "view/navigation.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace triptych {

namespace {
constexpr double steepest = std::numbers::pi / 2 - 0.01;
constexpr double faster_a_click = 1.25;
}  // namespace

Walker::Walker(const Camera& camera, double reach) : reach_(reach), speed_(reach / 10) { jump_to(camera); }

Walker Walker::before(const Box& box, double near) {
  Camera camera;
  set_field_of_view(camera, 60, 1);
  camera.near = near;
  const glm::dvec3 centre = (box.lo + box.hi) * 0.5;
  const double reach = glm::length(box.hi - box.lo);
  const double radius = std::max(reach / 2, 2 * near);
  const double distance = radius / std::sin(std::atan(camera.top));
  camera.eye = centre + distance * glm::normalize(glm::dvec3(0.5, 0.4, 0.8));
  camera.target = centre;
  return {camera, std::max(reach, 2 * near)};
}

void Walker::jump_to(const Camera& camera) {
  const glm::dvec3 sight = glm::normalize(camera.target - camera.eye);
  eye_ = camera.eye;
  up_ = glm::normalize(camera.up);
  const glm::dvec3 aside = std::abs(up_.z) < 0.9 ? glm::dvec3(0, 0, -1) : glm::dvec3(1, 0, 0);
  north_ = glm::normalize(aside - glm::dot(aside, up_) * up_);
  heading_ = std::atan2(glm::dot(sight, glm::cross(north_, up_)), glm::dot(sight, north_));
  pitch_ = std::clamp(std::asin(std::clamp(glm::dot(sight, up_), -1.0, 1.0)), -steepest, steepest);
  projection_ = camera.projection;
  half_height_ = (camera.top - camera.bottom) / 2;
  near_ = camera.near;
}

glm::dvec3 Walker::level_direction() const {
  return std::cos(heading_) * north_ + std::sin(heading_) * glm::cross(north_, up_);
}

glm::dvec3 Walker::direction() const { return std::cos(pitch_) * level_direction() + std::sin(pitch_) * up_; }

void Walker::move(const Motion& motion, double seconds, int window_height) {
  speed_ = std::clamp(speed_ * std::pow(faster_a_click, motion.wheel), reach_ * 1e-6, reach_ * 10);
  constexpr double without_field_of_view = std::numbers::pi / 3;  // a drag over the window turns by so much
  const double field_of_view =
      projection_ == Projection::perspective ? 2 * std::atan(half_height_) : without_field_of_view;
  const double radians_a_pixel = field_of_view / std::max(window_height, 1);
  heading_ = std::remainder(heading_ + motion.turn_right * radians_a_pixel, 2 * std::numbers::pi);
  pitch_ = std::clamp(pitch_ - motion.turn_down * radians_a_pixel, -steepest, steepest);
  const glm::dvec3 right = glm::cross(level_direction(), up_);
  eye_ += speed_ * seconds * (motion.forward * direction() + motion.right * right + motion.up * up_);
}

View Walker::view(int width, int height) const {
  View view{.camera = {.eye = eye_, .target = eye_ + reach_ * direction(), .up = up_},
            .width = width,
            .height = height};
  view.camera.top = half_height_;
  view.camera.bottom = -half_height_;
  view.camera.right = half_height_ * width / height;
  view.camera.left = -view.camera.right;
  view.camera.near = near_;
  view.camera.projection = projection_;
  return view;
}

}  // namespace triptych
