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

TEST(Navigation, looking_up_stops_when_it_is_straight_up) {
  Walker walker(camera_at({0, 0, 0}, {0, 0, -1}), 100);
  for (int i = 0; i < 100; ++i) walker.move({.turn_down = -100}, 0, 512);
  expect_near(walker.direction(), {0, 1, 0});
  expect_near(walker.view(512, 512).camera.up, {0, 0, 1});
  EXPECT_NO_THROW(check_camera(walker.view(512, 512).camera, "walker"));
  const Walker straight_down(camera_at({0, 0, 0}, {1e-7, -1, 0}), 100);
  EXPECT_NO_THROW(check_camera(straight_down.view(512, 512).camera, "walker"));
}

TEST(Navigation, the_speed_fits_what_is_seen_and_the_pace_is_the_person_s) {
  Walker walker(camera_at({0, 0, 0}, {0, 0, -1}), 100);
  walker.move({.faster = 1}, 0, 512);
  EXPECT_DOUBLE_EQ(walker.speed(), 12.5);
  walker.see(2);
  EXPECT_DOUBLE_EQ(walker.speed(), 2.5);
  walker.move({.faster = -1}, 0, 512);
  EXPECT_DOUBLE_EQ(walker.speed(), 2);
  walker.see(1e9);
  EXPECT_DOUBLE_EQ(walker.speed(), 100) << "no further than through the model";
  walker.see(0);
  EXPECT_DOUBLE_EQ(walker.speed(), 1e-3) << "and never stuck";
  walker.move({.faster = -1e6}, 0, 512);
  EXPECT_DOUBLE_EQ(walker.speed(), 1e-6);
}

/// Where a point is in the picture, from −1 to 1, and how deep.
glm::dvec3 seen(const Walker& walker, const glm::dvec3& point) {
  const View view = walker.view(300, 200);
  const glm::dvec3 eye = view.rotation() * (point - view.camera.eye);
  const double depth = view.camera.orthographic() ? 1 : -eye.z;
  return {eye.x / depth / view.camera.right, eye.y / depth / view.camera.top, -eye.z};
}

TEST(Navigation, orbiting_keeps_the_point_in_its_place) {
  Walker walker(camera_at({1, 2, 3}, {4, 1, -5}), 100);
  const glm::dvec3 point(6, 2, -9), before = seen(walker, point);
  walker.orbit(point, 37, -21, 512);
  EXPECT_GT(glm::distance(walker.eye(), glm::dvec3(1, 2, 3)), 0.5);
  expect_near(seen(walker, point), before);
  for (int i = 0; i < 50; ++i) walker.orbit(point, 3, -50, 512);  // until it looks straight up
  expect_near(walker.direction(), {0, 1, 0});
  expect_near(seen(walker, point), before);
  const glm::dvec3 eye = walker.eye();
  walker.orbit(point, 1024, 0, 512);
  expect_near(walker.eye(), eye);  // all round
}

TEST(Navigation, panning_moves_what_is_under_the_mouse_with_it) {
  for (const bool orthographic : {false, true}) {
    Camera camera = camera_at({1, 2, 3}, {4, 1, -5});
    if (orthographic) set_orthographic_height(camera, 20, 1);
    Walker walker(camera, 100);
    const glm::dvec3 point(6, 2, -9), before = seen(walker, point);
    walker.pan(point, 15, -10, 200);
    expect_near(seen(walker, point), before + glm::dvec3(2 * 15 / 300.0, 2 * 10 / 200.0, 0));
  }
}

TEST(Navigation, zooming_comes_nearer_to_the_point_and_keeps_it_in_its_place) {
  for (const bool orthographic : {false, true}) {
    Camera camera = camera_at({1, 2, 3}, {4, 1, -5});
    if (orthographic) set_orthographic_height(camera, 20, 1);
    Walker walker(camera, 100);
    const glm::dvec3 point(6, 2, -9), before = seen(walker, point);
    walker.zoom(point, 1);
    const glm::dvec3 after = seen(walker, point);
    EXPECT_NEAR(after.x, before.x, 1e-9);
    EXPECT_NEAR(after.y, before.y, 1e-9);
    EXPECT_NEAR(after.z, (orthographic ? 1 : 0.8) * before.z, 1e-9);
    EXPECT_NEAR(walker.view(200, 200).camera.top, orthographic ? 8 : camera.top, 1e-9);
    walker.zoom(point, -1);
    expect_near(seen(walker, point), before);
    walker.zoom(point, 1000);
    EXPECT_GE(seen(walker, point).z, 2 * camera.near - 1e-9) << "not through it";
    EXPECT_NO_THROW(check_camera(walker.view(200, 200).camera, "walker"));
  }
}

TEST(Navigation, a_side_shows_all_of_a_box_that_is_fitted_in) {
  const Box box{{-3, 0, -1}, {5, 2, 30}};
  for (const bool orthographic : {false, true}) {
    for (const Side side : {Side::front, Side::right, Side::top}) {
      Walker walker(camera_at({100, 3, 0}, {0, 0, 0}), 100);
      if (orthographic) walker.switch_projection({0, 0, 0}, false);
      walker.look_at(side);
      walker.frame(box, 1.5);
      double largest = 0;
      for (int i = 0; i < 8; ++i) {
        const glm::dvec3 corner = seen(walker, box.corner(i));
        largest = std::max({largest, std::abs(corner.x), std::abs(corner.y)});
        EXPECT_LE(std::abs(corner.x), 1);
        EXPECT_LE(std::abs(corner.y), 1);
        EXPECT_GT(corner.z, 0.5) << "before the near plane";
      }
      EXPECT_NEAR(largest, 0.9, 1e-9) << "and not much more";
      const glm::dvec3 wanted = side == Side::front   ? glm::dvec3(0, 0, -1)
                                : side == Side::right ? glm::dvec3(-1, 0, 0)
                                                      : glm::dvec3(0, -1, 0);
      expect_near(walker.direction(), wanted);
    }
  }
}

TEST(Navigation, projections_change_and_what_was_looked_at_stays_as_large) {
  Walker walker(camera_at({1, 2, 3}, {4, 1, -5}), 100);
  const glm::dvec3 point(6, 2, -9), eye = walker.eye(), before = seen(walker, point);
  for (const bool stays : {true, false}) {
    walker.switch_projection(point, stays);
    EXPECT_EQ(walker.eye() == eye, stays);
    if (stays) walker.switch_projection(point, stays);
  }
  ASSERT_TRUE(walker.orthographic());
  EXPECT_NEAR(seen(walker, point).x, before.x, 1e-9);
  EXPECT_NEAR(seen(walker, point).y, before.y, 1e-9);
  walker.switch_projection(point, false);
  EXPECT_FALSE(walker.orthographic());
  expect_near(walker.eye(), eye);
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
