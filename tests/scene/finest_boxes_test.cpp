// How large a model is, whatever its levels reach.
#include "scene/finest_boxes.hpp"

#include "scene/pack.hpp"
#include "tests/support/small_pack.hpp"

#include <filesystem>

namespace triptych {
namespace {

TEST(FinestBoxes, are_of_what_is_shown_at_full_detail) {
  test::SmallPack small = test::small_pack();
  // Coarse levels that reach a unit further: 8 steps.
  for (SceneNode& node : small.skeleton.scene_nodes) {
    node.box.lo -= 8;
    node.box.hi += 8;
  }
  const auto file = test::write_pack(small);
  const Pack pack(file);
  const std::vector<Box> boxes = finest_boxes(pack.skeleton());
  ASSERT_EQ(boxes.size(), 3u);
  EXPECT_EQ(boxes[1], (Box{{0, 0, 0}, {8, 8, 0.5}}));
  EXPECT_EQ(boxes[2], (Box{{32, 2, 0}, {40, 10, 0.5}})) << "placed turned";
  EXPECT_EQ(boxes[0], (Box{{0, 0, 0}, {40, 10, 0.5}}));
  EXPECT_EQ(model_box(pack.skeleton()), boxes[0]);
  EXPECT_TRUE(model_box(Skeleton()).empty());
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace triptych
