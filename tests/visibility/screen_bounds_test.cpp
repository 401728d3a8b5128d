// Where boxes may appear on the screen: never too small, never too far, and unbounded where it cannot be
// known.
#include "visibility/screen_bounds.hpp"

#include "tests/support/scenes.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace triptych {
namespace {

using Kind = ScreenBounds::Kind;

class ScreenBoundsOf : public testing::Test {
 protected:
  ScreenBoundsOf() {
    skeleton.lattices = {Lattice{{0, 0, 0}, 0x1p-10}};
    skeleton.scene_nodes = {{.box = skeleton.lattice().enclosing({glm::dvec3(-40), glm::dvec3(40)})}};
    view.camera = {.eye = {0, 0, 0}, .target = {0, 0, -1}, .up = {0, 1, 0}, .near = 0.125};
    view.width = view.height = 512;
  }
  ScreenBounds bounds(const glm::dvec3& lo, const glm::dvec3& hi) const {
    return BoxProjector(FrameView(skeleton, {view})).bounds(skeleton.lattice().enclosing({lo, hi}));
  }
  Skeleton skeleton;
  View view;
};

TEST_F(ScreenBoundsOf, a_box_before_the_eye_are_a_rectangle_with_half_a_pixel_of_margin) {
  const ScreenBounds found = bounds({-0.5, -1, -4}, {1, 0.5, -2});
  ASSERT_EQ(found.kind, Kind::rectangle);
  const float margin = 1.0f / 512;
  EXPECT_FLOAT_EQ(found.rectangle.left, -0.25f - margin);
  EXPECT_FLOAT_EQ(found.rectangle.right, 0.5f + margin);
  EXPECT_FLOAT_EQ(found.rectangle.bottom, -0.5f - margin);
  EXPECT_FLOAT_EQ(found.rectangle.top, 0.25f + margin);
  EXPECT_GT(found.rectangle.depth(0, 0), 0.0625f);
  EXPECT_LT(found.rectangle.depth(0, 0), 0.0626f);
}

TEST_F(ScreenBoundsOf, a_box_beside_the_eye_follow_its_face) {
  // A floor one unit below the eye, from behind it to 30 units before it.
  const ScreenBounds found = bounds({-30, -2, -30}, {30, -1, 5});
  ASSERT_EQ(found.kind, Kind::rectangle);
  EXPECT_EQ(found.rectangle.left, -1);
  EXPECT_EQ(found.rectangle.top, 1);
  // At y = -0.5 the floor is 2 units away, at -0.25 it is 4; above the horizon it is nowhere.
  EXPECT_NEAR(found.rectangle.depth(0.3f, -0.5f), 0.125 / 2, 1e-3);
  EXPECT_NEAR(found.rectangle.depth(-0.9f, -0.25f), 0.125 / 4, 1e-3);
  EXPECT_LT(found.rectangle.depth(0, 0.01f), 0);
}

TEST_F(ScreenBoundsOf, a_box_that_touches_the_eye_plane_before_it_are_unknown) {
  EXPECT_EQ(bounds({-1, -1, -5}, {1, 1, -0.1}).kind, Kind::unbounded);
  EXPECT_EQ(bounds({-1, -1, -5}, {1, 1, 3}).kind, Kind::unbounded);
  EXPECT_EQ(bounds({-1, -1, -5}, {1, 1, -0.125}).kind, Kind::unbounded) << "it touches the near plane";
}

TEST_F(ScreenBoundsOf, a_box_around_the_eye_are_unknown) {
  EXPECT_EQ(bounds({-1, -1, -1}, {1, 1, 1}).kind, Kind::unbounded);
  EXPECT_EQ(bounds({0, 0, -1}, {1, 1, 0}).kind, Kind::unbounded) << "the eye is its corner";
  EXPECT_EQ(bounds({-1, -1, 0}, {1, 1, 0}).kind, Kind::off_screen)
      << "the eye is on it, all of it is too near";
}

TEST_F(ScreenBoundsOf, a_box_behind_or_beside_the_view_are_off_the_screen) {
  EXPECT_EQ(bounds({-1, -1, 1}, {1, 1, 5}).kind, Kind::off_screen);
  EXPECT_EQ(bounds({20, -1, -5}, {30, 1, -4}).kind, Kind::off_screen);
  EXPECT_EQ(bounds({-1, -30, -5}, {1, -20, -4}).kind, Kind::off_screen);
}

TEST_F(ScreenBoundsOf, a_flat_box_and_a_point_are_rectangles_too) {
  const ScreenBounds flat = bounds({-0.5, -0.5, -2}, {0.5, 0.5, -2});
  ASSERT_EQ(flat.kind, Kind::rectangle);
  const ScreenBounds point = bounds({0, 0, -2}, {0, 0, -2});
  ASSERT_EQ(point.kind, Kind::rectangle);
  EXPECT_FLOAT_EQ(point.rectangle.right - point.rectangle.left, 2.0f / 512) << "half a pixel on each side";
}

TEST_F(ScreenBoundsOf, a_box_in_a_narrow_view_are_known_with_as_many_pixels_of_margin_as_rounding_asks_for) {
  view.width = view.height = 1080;
  for (const double side : {0x1p-2, 0x1p-7, 0x1p-10}) {
    view.camera.right = view.camera.top = side;
    view.camera.left = view.camera.bottom = -side;
    const ScreenBounds found = bounds({-side, -side, -2}, {side, side, -2});
    ASSERT_EQ(found.kind, Kind::rectangle) << side;
    const double rounding = 0x1p-18 * view.focal_length();
    const double edge = 0.5 + 2.0 / 1080 * std::max(0.5, 4 * rounding);
    EXPECT_GE(found.rectangle.right, edge * 0.9999) << side;
  }
  EXPECT_LT(bounds({0, 0, -2}, {0, 0, -2}).rectangle.right, 0.1f) << "the margin is no more than it must be";
}

/// At any place and under any lopsided frustum.
View some_view(scenes::Random& random) {
  View view;
  view.width = 16 + static_cast<int>(random.index(2000));
  view.height = 16 + static_cast<int>(random.index(2000));
  view.camera.eye = random.vector(-20, 20);
  view.camera.target = view.camera.eye + random.vector(-1, 1);
  view.camera.up = random.vector(-1, 1);
  view.camera.left = random.number(-3, 0.5);
  view.camera.right = view.camera.left + random.number(0.01, 3);
  view.camera.bottom = random.number(-3, 0.5);
  view.camera.top = view.camera.bottom + random.number(0.01, 3);
  view.camera.near = std::exp2(random.number(-10, 1));
  if (random.index(4) == 0) {
    view.camera.projection = Projection::orthographic;
    for (double* side : {&view.camera.left, &view.camera.right, &view.camera.bottom, &view.camera.top})
      *side *= 8;
  }
  return view;
}

Box some_box(scenes::Random& random) {
  const glm::dvec3 lo = random.vector(-20, 20);
  return {lo, lo + random.vector() * std::exp2(random.number(-8, 4))};
}

TEST_F(ScreenBoundsOf, a_box_hold_every_point_of_it) {
  scenes::Random random(41);
  int rectangles = 0, points = 0, cuts = 0;
  for (int round = 0; round < 40000; ++round) {
    view = some_view(random);
    const LatticeBox lattice_box = skeleton.lattice().enclosing(some_box(random));
    const Box box = skeleton.lattice().box(lattice_box);
    const ScreenBounds found = BoxProjector(FrameView(skeleton, {view})).bounds(lattice_box);
    if (found.kind == Kind::unbounded) continue;
    rectangles += found.kind == Kind::rectangle;
    const glm::mat<3, 3, long double> rotation(view.rotation());
    for (int i = 0; i < 24; ++i) {
      const glm::dvec3 point = i < 8 ? box.corner(i) : box.lo + (box.hi - box.lo) * random.vector();
      using Precise = glm::vec<3, long double>;
      const Precise eye_point = rotation * (Precise(point) - Precise(view.camera.eye));
      const long double depth = -eye_point.z;
      if (depth < view.camera.near) {
        continue;  // the near plane cuts it off
      }
      const auto device = [&](long double tangent, double low, double high) {
        return 2 * (tangent - low) / (high - low) - 1;
      };
      const long double w = view.camera.orthographic() ? 1 : depth;
      const long double x = device(eye_point.x / w, view.camera.left, view.camera.right);
      const long double y = device(eye_point.y / w, view.camera.bottom, view.camera.top);
      if (std::abs(x) > 1 || std::abs(y) > 1) continue;
      ASSERT_EQ(found.kind, Kind::rectangle) << "a point of it is on the screen";
      const ScreenRectangle& r = found.rectangle;
      // Sub-pixel snapping and the vertex stage may move it by 0.45 of a pixel; the edges of the screen are
      // clipped.
      const long double pixel_x = 0.9L / view.width, pixel_y = 0.9L / view.height;
      EXPECT_TRUE(r.left <= std::max(x - pixel_x, -1.0L) && r.right >= std::min(x + pixel_x, 1.0L));
      EXPECT_TRUE(r.bottom <= std::max(y - pixel_y, -1.0L) && r.top >= std::min(y + pixel_y, 1.0L));
      for (const HalfPlane& cut : r.cuts) {
        for (const long double side_x : {x - pixel_x, x + pixel_x}) {
          for (const long double side_y : {y - pixel_y, y + pixel_y})
            EXPECT_GE(cut.at(static_cast<float>(side_x), static_cast<float>(side_y)), 0);
        }
        cuts += cut.normal.x != 0;
      }
      const long double exact = FrameView(skeleton, {view}).clip.depth(static_cast<double>(depth));
      const DepthBound bound = BoxProjector(FrameView(skeleton, {view})).depth_bound(lattice_box);
      const auto at_x = static_cast<float>(x), at_y = static_cast<float>(y);
      EXPECT_GE(bound.nearest, std::min(1.0L, exact * (1 + 0x1p-16L)));
      for (const DepthPlane& plane : bound.planes) EXPECT_GE(plane.at(at_x, at_y), std::min(1.0L, exact));
      EXPECT_GE(r.depth(at_x, at_y), std::min(1.0L, exact));
      ++points;
    }
  }
  EXPECT_GT(rectangles, 1000);
  EXPECT_GT(points, 10000);
  EXPECT_GT(cuts, 10000);
}

TEST_F(ScreenBoundsOf, a_box_hold_all_that_boxes_in_it_may_draw) {
  scenes::Random random(42);
  int compared = 0;
  for (int round = 0; round < 40000; ++round) {
    view = some_view(random);
    const Box outer = some_box(random);
    const glm::dvec3 size = outer.hi - outer.lo, lo = outer.lo + size * random.vector();
    const Box inner{lo, lo + (outer.hi - lo) * random.vector()};
    const ScreenBounds around = bounds(outer.lo, outer.hi), within = bounds(inner.lo, inner.hi);
    if (around.kind == Kind::off_screen) {
      EXPECT_EQ(within.kind, Kind::off_screen);
    }
    if (around.kind != Kind::rectangle) continue;
    if (within.kind == Kind::off_screen) continue;
    const DepthBound allowed =
        BoxProjector(FrameView(skeleton, {view})).depth_bound(skeleton.lattice().enclosing(inner));
    for (int i = 0; i < 8; ++i) {
      const auto x = static_cast<float>(random.number(-1, 1)), y = static_cast<float>(random.number(-1, 1));
      float nearest = std::min(1.0f, allowed.nearest);
      for (const DepthPlane& plane : allowed.planes) nearest = std::min(nearest, plane.at(x, y));
      // What no fragment passes need not be held.
      if (nearest > 0) {
        EXPECT_GE(around.rectangle.depth(x, y), nearest);
      }
    }
    if (within.kind == Kind::unbounded) continue;
    EXPECT_LE(around.rectangle.left, within.rectangle.left);
    EXPECT_LE(around.rectangle.bottom, within.rectangle.bottom);
    EXPECT_GE(around.rectangle.right, within.rectangle.right);
    EXPECT_GE(around.rectangle.top, within.rectangle.top);
    ++compared;
  }
  EXPECT_GT(compared, 1000);
}

}  // namespace
}  // namespace triptych
