// Edges lie where a surface ends before another one or is folded, however obliquely it is seen; nowhere else.
#include "visibility/edge_rule.hpp"

#include "tests/support/scenes.hpp"

#include <functional>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

namespace triptych {
namespace {

class Edges : public testing::TestWithParam<Projection> {
 protected:
  static constexpr int width = 400, height = 300;

  static FrameView view() {
    View view{
        .camera = {.eye = {0, 0, 0}, .target = {0, 0, -1}, .near = 0.1}, .width = width, .height = height};
    if (GetParam() == Projection::orthographic) {
      set_orthographic_height(view.camera, 3, 4.0 / 3);
    } else {
      set_field_of_view(view.camera, 60, 4.0 / 3);
    }
    return {scenes::pack("room").skeleton(), {view, 1}};
  }
  /// What shows at a place of the picture of the plane through a point, in eye space.
  SurfacePoint point(const glm::dvec3& normal, const glm::dvec3& through, const glm::dvec2& at) const {
    const glm::vec4& rays = rule.rays();
    const glm::dvec2 side(rays.x * at.x + rays.z, rays.y * at.y + rays.w);
    const double reach = glm::dot(normal, through);
    const double z = GetParam() == Projection::orthographic
                         ? (reach - normal.x * side.x - normal.y * side.y) / normal.z
                         : -reach / glm::dot(normal, glm::dvec3(side, -1));
    return {static_cast<float>(frame.clip.depth(-z)), glm::vec3(glm::normalize(normal))};
  }
  EdgeOwner between(const SurfacePoint& first, const SurfacePoint& second, const glm::dvec2& at) const {
    return rule.between(first, glm::vec2(at), second, glm::vec2(at + glm::dvec2(1, 0)));
  }

  FrameView frame = view();
  EdgeRule rule{frame};
  /// One pixel is so wide at a depth of 5.
  const double pixel = GetParam() == Projection::orthographic ? 3.0 / height : 5 / frame.focal_length;
};

TEST_P(Edges, lie_nowhere_on_a_plane_however_it_is_turned) {
  scenes::Random random(3);
  for (int i = 0; i < 20000; ++i) {
    const glm::dvec3 normal = glm::normalize(random.vector(-1, 1) + glm::dvec3(0, 0, 1e-3)),
                     through(0, 0, -5);
    if (std::abs(normal.z) < 0.02) continue;
    const glm::dvec2 at(random.number(0.5, width - 1.5), random.number(0.5, height - 0.5));
    const SurfacePoint first = point(normal, through, at),
                       second = point(normal, through, at + glm::dvec2(1, 0));
    if (!(first.depth > 5e-3 && first.depth < 1 && second.depth > 5e-3 && second.depth < 1)) continue;
    EXPECT_EQ(between(first, second, at), EdgeOwner::none) << normal.x << " " << normal.y << " " << normal.z;
  }
}

TEST_P(Edges, lie_on_the_nearer_side_where_a_surface_ends_before_another) {
  const glm::dvec2 at(200, 150);
  const glm::dvec3 towards(0, 0, 1);
  const SurfacePoint near = point(towards, {0, 0, -5}, at), nothing;
  const auto behind = [&](double pixels) { return point(towards, {0, 0, -5 - pixels * pixel}, at); };
  EXPECT_EQ(between(near, behind(4), at), EdgeOwner::first);
  EXPECT_EQ(between(behind(4), near, at), EdgeOwner::second);
  EXPECT_EQ(between(near, behind(0.5 * double{step_pixels}), at), EdgeOwner::none) << "too small a step";
  EXPECT_EQ(between(near, nothing, at), EdgeOwner::first);
  EXPECT_EQ(between(nothing, near, at), EdgeOwner::second);
  EXPECT_EQ(between(nothing, nothing, at), EdgeOwner::none);
}

TEST_P(Edges, lie_where_faces_meet_at_an_angle_whichever_sides_their_normals_are_of) {
  const glm::dvec2 at(200, 150);
  const glm::dvec3 ridge(0, 0, -5);
  for (const double angle : {10.0, 30.0, 39.0, 41.0, 90.0, 120.0}) {
    for (const double side : {1.0, -1.0}) {
      const double half = glm::radians(angle / 2);
      const glm::dvec3 left(-std::sin(half), 0, std::cos(half)), right(std::sin(half), 0, std::cos(half));
      const SurfacePoint first = point(left, ridge, at - glm::dvec2(0.5, 0)),
                         second = point(right * side, ridge, at + glm::dvec2(0.5, 0));
      EXPECT_EQ(between(first, second, at - glm::dvec2(0.5, 0)),
                angle > 40 ? EdgeOwner::first : EdgeOwner::none)
          << angle;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Projections, Edges,
                         testing::Values(Projection::perspective, Projection::orthographic),
                         [](const auto& parameter) {
                           return parameter.param == Projection::perspective ? "perspective" : "orthographic";
                         });

}  // namespace
}  // namespace triptych
