#include "preprocess/build_hierarchy.hpp"

#include <gtest/gtest.h>
#include <random>
#include <set>

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

/// Which objects lie below each inner node.
std::set<std::set<uint32_t>> groups_of(const std::vector<HierarchyNode>& nodes) {
  std::vector<std::set<uint32_t>> below(nodes.size());
  for (size_t i = nodes.size(); i-- > 0;) {
    if (nodes[i].child_count == 0) below[i].insert(nodes[i].object);
    if (i > 0) below[nodes[i].parent].insert(below[i].begin(), below[i].end());
  }
  std::set<std::set<uint32_t>> groups;
  for (const auto& group : below) {
    if (group.size() > 1) groups.insert(group);
  }
  return groups;
}

/// Objects of some files, which share one place.
struct Files {
  Files(uint32_t files, uint32_t each, uint32_t seed) {
    std::mt19937 random(seed);
    for (uint32_t file = 0; file < files; ++file) add(file, each, random);
  }
  void add(uint32_t file, uint32_t count, std::mt19937& random) {
    for (uint32_t i = 0; i < count; ++i) {
      const auto within = [&](uint32_t size) { return static_cast<double>(random() % (100 * size)) / 100; };
      const glm::dvec3 lo{within(60) - 20, within(10), within(40)};
      objects.push_back({{lo, lo + 1.0}, 100 + random() % 1000});
      of.push_back(file);
    }
  }
  std::vector<HierarchyNode> nodes() const {
    return build_hierarchy(objects, HierarchyKind::partition_cluster_partition, {}, of);
  }
  std::vector<ObjectExtent> objects;
  std::vector<uint32_t> of;
};

TEST(Hierarchy, of_several_files_is_sound) {
  for (const uint32_t files : {2u, 3u, 5u, 9u, 30u}) {
    const Files model(files, 40, files);
    expect_sound(model.nodes(), 40 * files);
    EXPECT_LE(depth_of(model.nodes()), 14u);
  }
  Files one_place(3, 100, 1);
  for (ObjectExtent& object : one_place.objects) object.box = {{0, 0, 0}, {1, 1, 1}};
  expect_sound(one_place.nodes(), 300);
  EXPECT_LE(depth_of(one_place.nodes()), 6u);
}

TEST(Hierarchy, nodes_of_a_file_stay_as_they_are_when_another_one_changes) {
  Files model(5, 200, 7), changed = model;
  changed.objects.resize(800);  // all of the last file is another, and more
  changed.of.resize(800);
  std::mt19937 random(8);
  changed.add(4, 230, random);
  /// Which share of the nodes without an object of the last file are there after the change.
  const auto kept_of = [&](const std::vector<HierarchyNode>& nodes, const std::vector<HierarchyNode>& later) {
    const auto after = groups_of(later);
    size_t all = 0, kept = 0;
    for (const std::set<uint32_t>& group : groups_of(nodes)) {
      if (*group.rbegin() >= 800) continue;
      ++all;
      kept += after.count(group);
    }
    return static_cast<double>(kept) / static_cast<double>(all);
  };
  EXPECT_GT(kept_of(model.nodes(), changed.nodes()), 0.8);
  EXPECT_LT(kept_of(build_hierarchy(model.objects), build_hierarchy(changed.objects)), 0.5);
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
