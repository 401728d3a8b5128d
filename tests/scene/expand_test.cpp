#include "scene/expand.hpp"

#include "base/error.hpp"
#include "tests/support/instanced_pack.hpp"

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

namespace triptych {
namespace {

using test::instanced_pack;
using test::InstancedPack;

/// With the chunk table that a written pack has.
StoredSkeleton stored_skeleton(const InstancedPack& pack = instanced_pack()) {
  StoredSkeleton stored = pack.skeleton;
  for (size_t i = 0; i < pack.chunks.size(); ++i) {
    stored.surrounding.chunks.push_back(
        {.triangle_count = static_cast<uint32_t>(pack.chunks[i].triangle_count()),
         .lattice = pack.chunk_lattices[i],
         .box = pack.chunks[i].box()});
  }
  return stored;
}

Skeleton expanded(const StoredSkeleton& stored) { return expand(stored, "pack"); }

/// Calls `visit` with every vertex that the drawable draws, model space.
void each_vertex(const Skeleton& skeleton, const std::vector<Chunk>& chunks, DrawableId id,
                 const std::function<void(const glm::dvec3&)>& visit) {
  const Drawable& drawable = skeleton.drawables[id];
  for (uint32_t i = 0; i < drawable.placement_count; ++i) {
    const Placement& placement = skeleton.placements[drawable.first_placement + i];
    const Lattice& lattice = skeleton.lattices[skeleton.chunks[placement.chunk].lattice];
    for (const ChunkVertex& vertex : chunks[placement.chunk].vertices) {
      visit(skeleton.transforms[placement.transform] * glm::dvec4(lattice.position(vertex.point), 1));
    }
  }
}

void expect_whole(const Skeleton& skeleton, const std::vector<Chunk>& chunks) {
  for (SceneNodeId i = 0; i < skeleton.scene_nodes.size(); ++i) {
    const SceneNode& node = skeleton.scene_nodes[i];
    for (uint32_t child = 0; child < node.child_count; ++child)
      EXPECT_EQ(skeleton.scene_nodes[node.first_child + child].parent, i);
    for (uint32_t k = 0; k < node.drawable_count; ++k)
      EXPECT_EQ(skeleton.drawables[node.first_drawable + k].scene_node, i);
    if (i > 0) {
      EXPECT_LT(node.parent, i);
      EXPECT_TRUE(skeleton.scene_nodes[node.parent].box.contains(node.box)) << i;
    }
    EXPECT_FALSE(node.box.empty());
    EXPECT_TRUE(node.child_count > 0 || node.drawable_count > 0);
  }
  for (DrawableId id = 0; id < skeleton.drawables.size(); ++id) {
    const Box box = skeleton.lattice().box(skeleton.scene_nodes[skeleton.drawables[id].scene_node].box);
    each_vertex(skeleton, chunks, id, [&](const glm::dvec3& position) {
      EXPECT_TRUE(box.contains(Box{position, position})) << id;
    });
  }
}

TEST(Expand, a_skeleton_without_instances_stays_as_it_is) {
  const Skeleton flat = test::small_pack().skeleton;
  const Skeleton skeleton = expand({flat, {}, {}}, "pack");
  EXPECT_EQ(skeleton.scene_nodes, flat.scene_nodes);
  EXPECT_EQ(skeleton.drawables, flat.drawables);
  EXPECT_EQ(skeleton.placements, flat.placements);
  EXPECT_EQ(skeleton.transforms, flat.transforms);
  EXPECT_TRUE(skeleton.instances.empty());
  EXPECT_EQ(skeleton.sub_hierarchies, 0u);
}

TEST(Expand, ids_are_the_first_one_of_the_instance_plus_the_local_one) {
  const Skeleton skeleton = expanded(stored_skeleton());
  EXPECT_EQ(skeleton.sub_hierarchies, 2u);
  ASSERT_EQ(skeleton.scene_nodes.size(), 25u);
  ASSERT_EQ(skeleton.drawables.size(), 26u);
  ASSERT_EQ(skeleton.instances.size(), 7u);
  const SceneNodeId parents[] = {1, 2, 3, 5, 6, 8, 9}, firsts[] = {4, 7, 10, 13, 16, 19, 22};
  const DrawableId drawables[] = {1, 1, 1, 6, 11, 16, 21};
  const uint32_t hierarchies[] = {1, 1, 0, 0, 0, 0, 0};
  for (size_t i = 0; i < 7; ++i) {
    const ExpandedInstance& instance = skeleton.instances[i];
    EXPECT_EQ(instance.scene_node, parents[i]) << i;
    EXPECT_EQ(instance.first_scene_node, firsts[i]) << i;
    EXPECT_EQ(instance.scene_node_count, 3u) << i;
    EXPECT_EQ(instance.first_drawable, drawables[i]) << i;
    EXPECT_EQ(instance.drawable_count, hierarchies[i] == 0 ? 5u : 0u) << i;
    EXPECT_EQ(instance.sub_hierarchy, hierarchies[i]) << i;
    const SceneNode& node = skeleton.scene_nodes[parents[i]];
    EXPECT_EQ(node.first_child, firsts[i]) << i;
    EXPECT_EQ(node.child_count, 1u) << i;
  }
  EXPECT_EQ(skeleton.scene_nodes[16].first_child, 17u);
  EXPECT_EQ(skeleton.drawables[11].scene_node, 16u);
  EXPECT_EQ(skeleton.levels(), 6u);  // root, instance, pair, instance, small pack's root, leaf
}

TEST(Expand, boxes_hold_what_is_drawn_and_nest) {
  const InstancedPack pack = instanced_pack();
  expect_whole(expanded(stored_skeleton(pack)), pack.chunks);
}

TEST(Expand, transforms_are_composed_and_lattices_are_the_chunks_own) {
  const Skeleton skeleton = expanded(stored_skeleton());
  // Drawable 14: the finest of leaf 2 in the mirrored one of the first pair, chunk 2 turned on lattice 1.
  const Placement& placement = skeleton.placements[skeleton.drawables[14].first_placement];
  EXPECT_EQ(placement.chunk, 2u);
  // Mesh (1, 0, 0) is (40, 2, 0) in the small pack, (50, 2, 0) mirrored, (16, 100, 5) turned.
  EXPECT_EQ(skeleton.transforms[placement.transform] * glm::dvec4(1, 0, 0, 1), glm::dvec3(16, 100, 5));
  EXPECT_EQ(skeleton.transforms[skeleton.instances[2].transform][2], glm::dvec3(0, 0, 4));
}

TEST(Expand, errors_are_stretched_as_often_as_they_are_placed_and_never_shrink_towards_the_root) {
  StoredSkeleton stored = stored_skeleton();
  stored.sub_hierarchies[1].instances[1].stretch = 3;
  const Skeleton skeleton = expanded(stored);
  EXPECT_EQ(skeleton.drawables[1].error, 0.5 * 4);
  EXPECT_EQ(skeleton.drawables[6].error, 0.5 * 2);
  EXPECT_EQ(skeleton.drawables[11].error, 0.5 * 6);
  EXPECT_EQ(skeleton.drawables[16].error, 0.5);
  EXPECT_EQ(skeleton.drawables[21].error, 0.5 * 3);
  EXPECT_EQ(skeleton.drawables[7].error, 0);
  // Where the stored ones do not shrink, the expanded ones do not.
  const Skeleton whole = expanded(stored_skeleton());
  std::vector<double> below(whole.scene_nodes.size(), 0);
  for (SceneNodeId i = static_cast<SceneNodeId>(whole.scene_nodes.size()); i-- > 0;) {
    const SceneNode& node = whole.scene_nodes[i];
    for (uint32_t k = 0; k < node.drawable_count; ++k) {
      EXPECT_GE(whole.drawables[node.first_drawable + k].error, below[i]) << i;
      below[i] = whole.drawables[node.first_drawable + k].error;
    }
    if (i > 0) below[node.parent] = std::max(below[node.parent], below[i]);
  }
}

TEST(Expand, any_transform_leaves_boxes_that_hold_and_nest) {
  std::mt19937 random(5);
  const auto number = [&](double lo, double hi) {
    return lo + (hi - lo) * static_cast<double>(random()) * 0x1p-32;
  };
  for (int round = 0; round < 200; ++round) {
    InstancedPack pack = instanced_pack();
    const auto transform = [&] {
      glm::dmat4 matrix = glm::translate(glm::dmat4(1), {number(-9, 9), number(-9, 9), number(-9, 9)});
      const glm::dvec3 axis(number(-1, 1), number(-1, 1), number(0.1, 1));
      matrix = glm::rotate(matrix, number(0, 6.3), glm::normalize(axis));
      const double sign = random() % 2 == 0 ? -1 : 1;
      return Affine(glm::scale(matrix, {sign * number(0.1, 3), number(0.1, 3), number(0.1, 3)}));
    };
    // The model's lattice reaches ±1e8, and far enough so do the boxes of what stands for instances.
    constexpr int far = Lattice::limit;
    const LatticeBox all{{-far, -far, -far}, {far, far, far}};
    Skeleton& surrounding = pack.skeleton.surrounding;
    surrounding.drawables.clear();
    for (SceneNode& node : surrounding.scene_nodes) {
      node.box = all;
      node.drawable_count = 0;
    }
    for (size_t i = 1; i < 4; ++i) surrounding.transforms[i] = transform();
    SubHierarchy& pair = pack.skeleton.sub_hierarchies[1];
    pair.transforms[1] = transform();
    for (SceneNode& node : pair.scene_nodes) node.box = all;
    expect_whole(expanded(stored_skeleton(pack)), pack.chunks);
  }
}

TEST(Expand, more_than_ids_can_name_or_memory_may_hold_is_refused_before_it_is_made) {
  // Each sub-hierarchy holds two of the one before: 2^60 of the first.
  StoredSkeleton stored = stored_skeleton();
  const SubHierarchy pair = stored.sub_hierarchies[1];
  for (uint32_t i = 2; i < 60; ++i) {
    stored.sub_hierarchies.push_back(pair);
    for (HierarchyInstance& instance : stored.sub_hierarchies.back().instances)
      instance.sub_hierarchy = i - 1;
  }
  const auto refused = [&](uint32_t hierarchy, const std::string& why, uint64_t most = max_expanded_bytes) {
    stored.instances[0].sub_hierarchy = hierarchy;
    try {
      expand(stored, "pack", most);
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).find("pack: "), 0u);
      return;
    }
    ADD_FAILURE() << "was expanded";
  };
  refused(59, "32 bits");
  refused(22, "bytes of skeleton");
  refused(1, "bytes of skeleton", 1000);
  stored.instances[0].sub_hierarchy = 8;
  EXPECT_EQ(expand(stored, "pack").scene_nodes.size(), 4u + 3 * 511 + 9 + 3);
}

TEST(Expand, numbers_beyond_doubles_are_refused) {
  StoredSkeleton stored = stored_skeleton();
  stored.instances[0].stretch = 1e308;
  stored.sub_hierarchies[1].instances[0].stretch = 1e10;
  EXPECT_THROW(expanded(stored), Error);
  stored = stored_skeleton();
  stored.surrounding.transforms[1][0].y = 1e308;
  EXPECT_THROW(expanded(stored), Error);
}

}  // namespace
}  // namespace triptych
