#include "view/birds_eye.hpp"

#include "tests/support/scenes.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace triptych {
namespace {

TEST(BirdsEye, stands_above_the_eye_and_covers_nine_of_ten_boxes_of_the_cut) {
  const Skeleton& skeleton = scenes::pack("room").skeleton();
  const View view = scenes::path(skeleton, 200, 100).front();
  const Cut cut = select_cut(FrameView(skeleton, {view, 1}));
  const View above = birds_eye_view(skeleton, view, cut.drawables);
  EXPECT_NO_THROW(check_camera(above.camera, "above"));
  const glm::dvec3 up = glm::normalize(view.camera.up);
  EXPECT_NEAR(glm::length(glm::cross(glm::normalize(above.camera.eye - view.camera.eye), up)), 0, 1e-9);
  EXPECT_GT(glm::dot(above.camera.eye - view.camera.eye, up), 0);
  size_t covered = 0;
  for (const DrawableId id : cut.drawables) {
    const Box box = skeleton.lattice().box(skeleton.scene_nodes[skeleton.drawables[id].scene_node].box);
    glm::dvec3 centre = (box.lo + box.hi) * 0.5;
    centre -= glm::dot(centre - view.camera.eye, up) * up;  // at the eye's height
    const glm::dvec3 seen = above.rotation() * (centre - above.camera.eye);
    covered +=
        std::abs(seen.x) <= above.camera.right * -seen.z && std::abs(seen.y) <= above.camera.top * -seen.z;
  }
  EXPECT_GE(covered * 10, cut.drawables.size() * 9);
}

TEST(BirdsEye, has_a_direction_where_the_eye_looks_straight_down) {
  const Skeleton& skeleton = scenes::pack("room").skeleton();
  View view = scenes::path(skeleton, 200, 100).front();
  view.camera.target = view.camera.eye - view.camera.up;
  EXPECT_NO_THROW(check_camera(birds_eye_view(skeleton, view, {}).camera, "above"));
}

}  // namespace
}  // namespace triptych
