#include "view/navigation.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace triptych {
namespace {

Camera camera_at(const glm::dvec3& eye, const glm::dvec3& target) {
  Camera camera{.eye = eye, .target = target, .up = {0, 1, 0}};
  set_field_of_view(camera, 60, 1);
  camera.near = 0.5;
  return camera;
}

void expect_near(const glm::dvec3& found, const glm::dvec3& wanted) {
  EXPECT_LT(glm::length(found - wanted), 1e-9)
      << found.x << " " << found.y << " " << found.z << " instead of " << wanted.x << " " << wanted.y << " "
      << wanted.z;
}

TEST(Navigation, starts_where_the_camera_stands_and_sees_what_it_sees) {
  const Camera camera = camera_at({1, 2, 3}, {4, 1, -5});
  const Walker walker(camera, 100);
  const View view = walker.view(300, 300);
  expect_near(view.camera.eye, camera.eye);
  expect_near(walker.direction(), glm::normalize(camera.target - camera.eye));
  EXPECT_DOUBLE_EQ(view.camera.top, camera.top);
  EXPECT_DOUBLE_EQ(view.camera.near, camera.near);
}

TEST(Navigation, w_goes_along_the_line_of_sight_at_the_given_speed) {
  Walker walker(camera_at({0, 0, 0}, {0, 0, -1}), 100);
  walker.move({.forward = 1}, 0.5, 512);
  expect_near(walker.eye(), {0, 0, -5});  // a tenth of the model a second
  walker.move({.forward = -1}, 0.5, 512);
  expect_near(walker.eye(), {0, 0, 0});
}

TEST(Navigation, d_goes_to_the_right_and_e_goes_up_wherever_one_looks) {
  Walker walker(camera_at({0, 0, 0}, {0, -3, -1}), 100);
  walker.move({.right = 1}, 1, 512);
  expect_near(walker.eye(), {10, 0, 0});
  walker.move({.up = 1}, 1, 512);
  expect_near(walker.eye(), {10, 10, 0});
}

TEST(Navigation, the_mouse_turns_to_where_it_goes) {
  Walker walker(camera_at({0, 0, 0}, {0, 0, -1}), 100);
  walker.move({.turn_right = 10}, 0, 512);
  EXPECT_GT(walker.direction().x, 0);
  EXPECT_NEAR(walker.direction().y, 0, 1e-12);
  walker.move({.turn_down = 10}, 0, 512);
  EXPECT_LT(walker.direction().y, 0);
}

TEST(Navigation, a_drag_over_the_window_s_height_turns_by_the_field_of_view) {
  Walker walker(camera_at({0, 0, 0}, {0, 0, -1}), 100);
  walker.move({.turn_right = 512}, 0, 512);
  EXPECT_NEAR(glm::dot(walker.direction(), {0, 0, -1}), 0.5, 1e-9);  // 60 degrees
}

TEST(Navigation, looking_up_stops_before_the_world_tips_over) {
  Walker walker(camera_at({0, 0, 0}, {0, 0, -1}), 100);
  for (int i = 0; i < 100; ++i) walker.move({.turn_down = -100}, 0, 512);
  EXPECT_GT(walker.direction().y, 0.99);
  EXPECT_LT(walker.direction().z, 0);
  EXPECT_NO_THROW(check_camera(walker.view(512, 512).camera, "walker"));
  const Walker straight_down(camera_at({0, 0, 0}, {1e-7, -1, 0}), 100);
  EXPECT_NO_THROW(check_camera(straight_down.view(512, 512).camera, "walker"));
}

TEST(Navigation, the_wheel_changes_the_speed_within_limits) {
  Walker walker(camera_at({0, 0, 0}, {0, 0, -1}), 100);
  walker.move({.wheel = 1}, 0, 512);
  EXPECT_DOUBLE_EQ(walker.speed(), 12.5);
  walker.move({.wheel = -1}, 0, 512);
  EXPECT_DOUBLE_EQ(walker.speed(), 10);
  walker.move({.wheel = 1e6}, 0, 512);
  EXPECT_DOUBLE_EQ(walker.speed(), 1000);
  walker.move({.wheel = -1e6}, 0, 512);
  EXPECT_DOUBLE_EQ(walker.speed(), 1e-4);
}

TEST(Navigation, a_model_that_is_up_along_z_is_walked_upright) {
  Camera camera = camera_at({0, 0, 0}, {1, 0, 0});
  camera.up = {0, 0, 1};
  Walker walker(camera, 100);
  expect_near(walker.direction(), {1, 0, 0});
  walker.move({.up = 1}, 1, 512);
  expect_near(walker.eye(), {0, 0, 10});
  walker.move({.right = 1}, 1, 512);
  expect_near(walker.eye(), {0, -10, 10});
}

TEST(Navigation, an_orthographic_camera_stays_one) {
  Camera camera = camera_at({0, 0, 0}, {0, 0, -1});
  set_orthographic_height(camera, 40, 1);
  Walker walker(camera, 100);
  walker.move({.forward = 1, .turn_right = 1}, 1, 512);
  const View view = walker.view(200, 100);
  EXPECT_TRUE(view.camera.orthographic());
  EXPECT_DOUBLE_EQ(view.camera.top - view.camera.bottom, 40);
  EXPECT_DOUBLE_EQ(view.camera.right - view.camera.left, 80);
}

TEST(Navigation, a_box_is_looked_at_from_outside_and_is_wholly_in_sight) {
  const Box box{{-3, 0, -1}, {5, 2, 30}};
  const View view = Walker::before(box, 0.01).view(400, 400);
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 corner = view.rotation() * (box.corner(i) - view.camera.eye);
    ASSERT_LT(corner.z, 0);
    EXPECT_LE(std::abs(corner.x / corner.z), view.camera.right);
    EXPECT_LE(std::abs(corner.y / corner.z), view.camera.top);
  }
}

TEST(Navigation, a_box_without_extent_can_be_looked_at_too) {
  const View view = Walker::before({{1, 1, 1}, {1, 1, 1}}, 0.01).view(40, 40);
  EXPECT_NO_THROW(check_camera(view.camera, "walker"));
}

TEST(Navigation, a_wide_window_shows_more_at_its_sides_and_as_much_in_height) {
  const Walker walker(camera_at({0, 0, 0}, {0, 0, -1}), 100);
  const View narrow = walker.view(100, 100), wide = walker.view(300, 100);
  EXPECT_DOUBLE_EQ(narrow.camera.top, wide.camera.top);
  EXPECT_DOUBLE_EQ(3 * narrow.camera.right, wide.camera.right);
}

}  // namespace
}  // namespace triptych
