#include "preprocess/build_hierarchy.hpp"

#include <gtest/gtest.h>
#include <random>

namespace triptych {
namespace {

uint32_t depth_of(const std::vector<HierarchyNode>& nodes) {
  std::vector<uint32_t> depths(nodes.size(), 1);
  uint32_t deepest = 1;
  for (size_t i = 1; i < nodes.size(); ++i)
    deepest = std::max(deepest, depths[i] = depths[nodes[i].parent] + 1);
  return deepest;
}

void expect_sound(const std::vector<HierarchyNode>& nodes, size_t objects) {
  std::vector<int> seen(objects, 0);
  uint32_t next_child = 1;
  for (uint32_t i = 0; i < nodes.size(); ++i) {
    const HierarchyNode& node = nodes[i];
    if (i > 0) {
      EXPECT_LT(node.parent, i);
    }
    if (node.child_count == 0) {
      ++seen.at(node.object);
      EXPECT_EQ(node.end_place - node.first_place, 1u);
      continue;
    }
    EXPECT_GE(node.child_count, 2u);
    EXPECT_LE(node.child_count, 4u);
    EXPECT_EQ(node.first_child, next_child) << "breadth first";
    next_child += node.child_count;
    uint32_t place = node.first_place;
    for (uint32_t child = node.first_child; child < node.first_child + node.child_count; ++child) {
      EXPECT_EQ(nodes.at(child).parent, i);
      EXPECT_EQ(nodes[child].first_place, place);
      place = nodes[child].end_place;
    }
    EXPECT_EQ(place, node.end_place);
  }
  EXPECT_EQ(next_child, nodes.size());
  for (const int times : seen) EXPECT_EQ(times, 1);
}

TEST(Hierarchy, is_breadth_first_and_holds_every_object_once) {
  std::mt19937 random(3);
  for (const size_t count : {1u, 2u, 3u, 4u, 5u, 17u, 400u}) {
    std::vector<ObjectExtent> objects;
    for (size_t i = 0; i < count; ++i) {
      const glm::dvec3 lo{random() % 1000, random() % 1000, random() % 10};
      objects.push_back({{lo, lo + glm::dvec3(random() % 20, random() % 20, 1)}, random() % 1000});
    }
    expect_sound(build_hierarchy(objects), count);
  }
}

TEST(Hierarchy, a_thousand_boxes_at_one_place_make_no_deep_tree) {
  const std::vector<ObjectExtent> objects(1000, ObjectExtent{{{0, 0, 0}, {1, 1, 1}}, 12});
  const auto nodes = build_hierarchy(objects);
  expect_sound(nodes, 1000);
  EXPECT_LE(depth_of(nodes), 8u);  // balanced: 6
}

TEST(Hierarchy, boxes_that_double_in_size_make_no_deep_tree) {
  std::vector<ObjectExtent> objects;
  for (int i = 0; i < 500; ++i) objects.push_back({{glm::dvec3(0), glm::dvec3(std::exp2(i / 4.0))}, 12});
  const auto nodes = build_hierarchy(objects);
  expect_sound(nodes, 500);
  EXPECT_LE(depth_of(nodes), 26u);  // balanced: 5; box by box: 125
}

TEST(Hierarchy, what_stands_for_many_leaves_is_near_the_root) {
  std::mt19937 random(4);
  std::vector<ObjectExtent> objects;
  for (int i = 0; i < 400; ++i) {
    const glm::dvec3 lo{random() % 1000, random() % 1000, random() % 1000};
    objects.push_back({{lo, lo + 10.0}, 100});
  }
  std::vector<uint64_t> leaves(objects.size(), 1);
  leaves[100] = leaves[200] = 2000;
  const auto nodes = build_hierarchy(objects, HierarchyKind::partition_cluster_partition, leaves);
  expect_sound(nodes, 400);
  for (uint32_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].object != 100 && nodes[i].object != 200) continue;
    uint32_t depth = 0;
    for (uint32_t node = i; node != 0; node = nodes[node].parent) ++depth;
    EXPECT_LE(depth, 3u);
  }
  EXPECT_LE(depth_of(nodes), 9u);  // without: 6
  // Where all are one leaf each, it makes no difference that they say so.
  const std::vector<uint64_t> ones(objects.size(), 1);
  const auto plain = build_hierarchy(objects);
  const auto said = build_hierarchy(objects, HierarchyKind::partition_cluster_partition, ones);
  ASSERT_EQ(plain.size(), said.size());
  for (size_t i = 0; i < plain.size(); ++i) EXPECT_EQ(plain[i].object, said[i].object);
}

TEST(Hierarchy, groups_far_apart_are_parted_at_the_root) {
  std::vector<ObjectExtent> objects;
  for (int i = 0; i < 40; ++i) {
    const glm::dvec3 lo{(i % 2) * 1000 + i, 0, 0};
    objects.push_back({{lo, lo + 1.0}, 12});
  }
  const auto nodes = build_hierarchy(objects);
  for (uint32_t child = 1; child <= nodes[0].child_count; ++child) {
    Box box;
    std::vector<uint32_t> below = {child};
    for (size_t i = 0; i < below.size(); ++i) {
      const HierarchyNode& node = nodes[below[i]];
      if (node.child_count == 0) box.extend(objects[node.object].box);
      for (uint32_t k = 0; k < node.child_count; ++k) below.push_back(node.first_child + k);
    }
    EXPECT_LT(box.hi.x - box.lo.x, 500);
  }
}

}  // namespace
}  // namespace triptych
