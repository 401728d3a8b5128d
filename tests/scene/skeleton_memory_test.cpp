// What a skeleton says that it takes in memory.
#include "scene/skeleton_memory.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

TEST(SkeletonMemory, is_that_of_its_arrays_with_what_is_reserved) {
  Skeleton skeleton;
  EXPECT_EQ(skeleton_bytes(skeleton), 0);
  skeleton.scene_nodes.reserve(10);
  skeleton.scene_nodes.resize(7);
  skeleton.drawables.reserve(20);
  skeleton.drawables.resize(20);
  skeleton.pieces.reserve(5);
  skeleton.pieces.resize(5);
  EXPECT_EQ(skeleton_bytes(skeleton),
            10 * sizeof(SceneNode) + 20 * sizeof(Drawable) + 5 * sizeof(LatticeBox));
  for (const ArrayMemory& array : skeleton_memory(skeleton)) {
    const uint64_t expected = array.name == "scene nodes" ? 7
                              : array.name == "drawables" ? 20
                              : array.name == "pieces"    ? 5
                                                          : 0;
    EXPECT_EQ(array.count, expected) << array.name;
  }
}

TEST(SkeletonMemory, holds_what_divided_bodies_reach) {
  Skeleton skeleton;
  skeleton.scene_nodes.reserve(3);
  skeleton.scene_nodes.resize(3);
  const uint64_t before = skeleton_bytes(skeleton);
  skeleton.closed.bodies.resize(1);
  EXPECT_GE(skeleton_bytes(skeleton), before + sizeof(DividedBody) + 3 * sizeof(LatticeBox));
}

}  // namespace
}  // namespace triptych
