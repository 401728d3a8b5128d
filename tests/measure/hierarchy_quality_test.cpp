#include "measure/hierarchy_quality.hpp"

#include "tests/support/small_pack.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

/// A root over an inner node with two leaves, and one leaf; 100 cells along x.
Skeleton lopsided() {
  Skeleton skeleton;
  skeleton.scene_nodes = {
      {.box = {{0, 0, 0}, {99, 9, 9}},
       .first_child = 1,
       .child_count = 2,
       .first_drawable = 0,
       .drawable_count = 1},
      {.box = {{0, 0, 0}, {59, 9, 9}},
       .parent = 0,
       .first_child = 3,
       .child_count = 2,
       .first_drawable = 1,
       .drawable_count = 1},
      {.box = {{50, 0, 0}, {99, 9, 9}}, .parent = 0, .first_drawable = 2, .drawable_count = 2},
      {.box = {{0, 0, 0}, {29, 9, 9}}, .parent = 1, .first_drawable = 4, .drawable_count = 1},
      {.box = {{30, 0, 0}, {59, 9, 9}}, .parent = 1, .first_drawable = 5, .drawable_count = 1}};
  for (const uint32_t triangles : {10u, 20u, 40u, 30u, 50u, 60u}) {
    Drawable drawable;
    drawable.triangles = triangles;
    skeleton.drawables.push_back(drawable);
  }
  return skeleton;
}

}  // namespace

TEST(HierarchyQuality, depth_counts_scene_nodes_from_the_root_to_each_leaf) {
  const HierarchyQuality quality = hierarchy_quality(lopsided());
  EXPECT_DOUBLE_EQ(quality.depth.max, 3);
  EXPECT_DOUBLE_EQ(quality.depth.mean, (2 + 3 + 3) / 3.0);
}

TEST(HierarchyQuality, balance_is_the_lightest_child_over_the_heaviest) {
  EXPECT_DOUBLE_EQ(hierarchy_quality(lopsided()).balance.mean, (0.5 + 1) / 2);
}

TEST(HierarchyQuality, overlap_is_what_siblings_share_over_their_parent) {
  const HierarchyQuality quality = hierarchy_quality(lopsided());
  EXPECT_DOUBLE_EQ(quality.overlap.max, 0.1);  // ten cells of the root's hundred
  EXPECT_DOUBLE_EQ(quality.overlap.mean, 0.05);
}

TEST(HierarchyQuality, flat_siblings_overlap_by_their_area) {
  Skeleton skeleton = lopsided();
  for (SceneNode& node : skeleton.scene_nodes) node.box.hi.y = node.box.lo.y;
  EXPECT_DOUBLE_EQ(hierarchy_quality(skeleton).overlap.max, 0.1);
}

TEST(HierarchyQuality, levels_add_up_to_the_whole_pack) {
  const HierarchyQuality quality = hierarchy_quality(lopsided());
  ASSERT_EQ(quality.levels.size(), 3u);
  EXPECT_EQ(quality.levels[0].drawables, 1u);
  EXPECT_EQ(quality.levels[1].scene_nodes, 2u);
  EXPECT_EQ(quality.levels[1].leaves, 1u);
  EXPECT_EQ(quality.levels[1].drawables, 3u);
  EXPECT_EQ(quality.levels[1].triangles, 90u);
  EXPECT_EQ(quality.levels[2].triangles, 110u);
}

TEST(HierarchyQuality, of_a_single_leaf_is_a_depth_of_one_without_balance_or_overlap) {
  Skeleton skeleton;
  skeleton.scene_nodes = {{.box = {{0, 0, 0}, {1, 1, 1}}, .drawable_count = 1}};
  skeleton.drawables.resize(1);
  const HierarchyQuality quality = hierarchy_quality(skeleton);
  EXPECT_DOUBLE_EQ(quality.depth.max, 1);
  EXPECT_DOUBLE_EQ(quality.overlap.max, 0);
}

}  // namespace triptych
