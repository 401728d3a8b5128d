#include "view/navigation.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace triptych {

namespace {
constexpr double steepest = std::numbers::pi / 2;
constexpr double faster_a_step = 1.25, nearer_a_step = 0.8;
constexpr double usual_half_height = 0.57735026918962573;  // 60 degrees
constexpr double fitted_share = 0.9;                       // of the window, that what is fitted in takes
}  // namespace

Walker::Walker(const Camera& camera, double reach) : reach_(reach), seen_(reach / 10) { jump_to(camera); }

Walker Walker::before(const Box& box, double near) {
  Camera camera;
  set_field_of_view(camera, 60, 1);
  camera.near = near;
  camera.target = center(box);
  camera.eye = camera.target + glm::dvec3(0.5, 0.4, 0.8);
  Walker walker(camera, std::max(glm::length(box.hi - box.lo), 2 * near));
  walker.frame(box, 1);
  return walker;
}

void Walker::jump_to(const Camera& camera) {
  const glm::dvec3 sight = glm::normalize(camera.target - camera.eye);
  eye_ = camera.eye;
  up_ = glm::normalize(camera.up);
  const glm::dvec3 aside = std::abs(up_.z) < 0.9 ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0);
  north_ = glm::normalize(aside - glm::dot(aside, up_) * up_);
  heading_ = std::atan2(glm::dot(sight, glm::cross(north_, up_)), glm::dot(sight, north_));
  pitch_ = std::clamp(std::asin(std::clamp(glm::dot(sight, up_), -1.0, 1.0)), -steepest, steepest);
  projection_ = camera.projection;
  half_height_ = (camera.top - camera.bottom) / 2;
  half_height_at_1_ = orthographic() ? usual_half_height : half_height_;
  near_ = camera.near;
}

glm::dvec3 Walker::level_direction() const {
  return std::cos(heading_) * north_ + std::sin(heading_) * glm::cross(north_, up_);
}

glm::dvec3 Walker::direction() const { return std::cos(pitch_) * level_direction() + std::sin(pitch_) * up_; }

glm::dvec3 Walker::right() const { return glm::cross(level_direction(), up_); }

glm::dvec3 Walker::picture_up() const {
  return std::cos(pitch_) * up_ - std::sin(pitch_) * level_direction();
}

double Walker::depth_of(const glm::dvec3& point) const { return glm::dot(point - eye_, direction()); }

double Walker::units_a_pixel(double depth, int window_height) const {
  return 2 * half_height_ * (orthographic() ? 1 : depth) / std::max(window_height, 1);
}

void Walker::turn(double right, double up) {
  heading_ = std::remainder(heading_ + right, 2 * std::numbers::pi);
  pitch_ = std::clamp(pitch_ + up, -steepest, steepest);
}

void Walker::move(const WalkerMotion& motion, double seconds, int window_height) {
  pace_ = std::clamp(pace_ * std::pow(faster_a_step, motion.faster), 1e-3, 1e3);
  constexpr double without_field_of_view = std::numbers::pi / 3;  // a drag over the window turns by so much
  const double field_of_view = orthographic() ? without_field_of_view : 2 * std::atan(half_height_);
  const double radians_a_pixel = field_of_view / std::max(window_height, 1);
  turn(motion.turn_right * radians_a_pixel, -motion.turn_down * radians_a_pixel);
  eye_ += speed() * seconds * (motion.forward * direction() + motion.right * right() + motion.up * up_);
}

void Walker::orbit(const glm::dvec3& point, double right_pixels, double down_pixels, int window_height) {
  const glm::dvec3 way = point - eye_;
  const glm::dvec3 seen(glm::dot(way, right()), glm::dot(way, picture_up()), glm::dot(way, direction()));
  const double radians_a_pixel = std::numbers::pi / std::max(window_height, 1);
  turn(right_pixels * radians_a_pixel, -down_pixels * radians_a_pixel);
  eye_ = point - seen.x * right() - seen.y * picture_up() - seen.z * direction();
}

void Walker::pan(const glm::dvec3& point, double right_pixels, double down_pixels, int window_height) {
  const double units = units_a_pixel(std::max(depth_of(point), near_), window_height);
  eye_ += units * (down_pixels * picture_up() - right_pixels * right());
}

void Walker::zoom(const glm::dvec3& point, double steps) {
  const double left = std::pow(nearer_a_step, steps);
  if (!orthographic()) {
    // Not through what is looked at: the near plane would cut it.
    const double nearest = 2 * near_ / std::max(depth_of(point), 2 * near_);
    eye_ += (1 - std::max(left, std::min(nearest, 1.0))) * (point - eye_);
    return;
  }
  const glm::dvec3 way = point - eye_;
  const glm::dvec3 aside = way - glm::dot(way, direction()) * direction();
  eye_ += (1 - left) * aside;
  half_height_ = std::clamp(half_height_ * left, reach_ * 1e-9, reach_ * 10);
}

void Walker::frame(const Box& box, double aspect, double most) {
  const glm::dvec3 centre = center(box), half = box.hi - centre, sight = direction();
  const double front = glm::dot(half, glm::abs(sight));  // how far before its middle
  double back = front + 2 * near_, half_height = 2 * near_;
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 way = box.corner(i) - centre;
    const double aside = std::abs(glm::dot(way, right())), above = std::abs(glm::dot(way, picture_up()));
    const double high = std::max(above, aside / aspect) / fitted_share;
    half_height = std::max(half_height, high);
    back = std::max(back, high / half_height_ - glm::dot(way, sight));
  }
  if (orthographic()) {
    half_height_ = half_height;
    back = glm::length(half) + reach_;  // nothing of the model is behind the eye
  }
  eye_ = centre - (most > front + near_ ? std::min(back, most) : back) * sight;
}

void Walker::look_at(Side side) {
  heading_ = side == Side::right ? -std::numbers::pi / 2 : 0;
  pitch_ = side == Side::top ? -steepest : 0;
}

void Walker::switch_projection(const glm::dvec3& point, bool stays) {
  const double depth = std::max(depth_of(point), 2 * near_);
  if (orthographic()) {
    const double now = half_height_ / half_height_at_1_;  // how deep a perspective picture is as large
    eye_ += (depth - now) * direction();
    half_height_ = half_height_at_1_;
    projection_ = Projection::perspective;
  } else {
    half_height_at_1_ = half_height_;
    half_height_ *= depth;
    if (!stays) eye_ -= reach_ * direction();  // what comes into the picture is not behind the eye
    projection_ = Projection::orthographic;
  }
}

void Walker::see(double distance) { seen_ = std::clamp(distance, reach_ * 1e-5, reach_); }

View Walker::view(int width, int height) const {
  View view{.camera = {.eye = eye_, .target = eye_ + reach_ * direction(), .up = picture_up()},
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
