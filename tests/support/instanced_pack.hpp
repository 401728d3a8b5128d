// A pack made by hand in which hierarchies stand in several places, one of them within the other.
#pragma once

#include "scene/sub_hierarchy.hpp"
#include "tests/support/small_pack.hpp"

#include <glm/mat4x4.hpp>

namespace triptych::test {

struct InstancedPack {
  std::vector<Chunk> chunks;
  std::vector<uint32_t> chunk_lattices;
  StoredSkeleton skeleton;
};

/// Columns x, y, z are scaled axes; then moved.
inline Affine axes(const glm::dvec3& x, const glm::dvec3& y, const glm::dvec3& z, const glm::dvec3& at) {
  return {x, y, z, at};
}

/// Sub-hierarchy 0: all of small_pack(), x in 0..40, y in 0..10, z in 0..0.5. Sub-hierarchy 1, a pair: one
/// of it as it is, and one mirrored, x in 50..90. The model: a pair, turned and twice as large, with a
/// drawable of its own (both flat squares of both); a pair that is only moved; a sub-hierarchy 0, four times
/// as high.
///
/// Expanded, scene nodes: 0..3 the model's root and instances, 4..6 and 7..9 the pairs, 10..12 the single
/// one, then those in the pairs: 13..15, 16..18 (mirrored), 19..21, 22..24 (mirrored). Drawables: 0, then 5
/// each of the single one, and of those in the pairs.
inline InstancedPack instanced_pack() {
  SmallPack small = small_pack();
  InstancedPack pack;
  pack.chunks = std::move(small.chunks);
  pack.chunk_lattices = {2, 2, 1};
  Skeleton& surrounding = pack.skeleton.surrounding;
  surrounding = std::move(small.skeleton);
  surrounding.lattices.push_back(surrounding.lattices[0]);
  const Affine moved = surrounding.transforms[2];
  const Affine mirrored = axes({-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {90, 0, 0});
  pack.skeleton.sub_hierarchies.push_back({.lattice = 2,
                                           .scene_nodes = std::move(surrounding.scene_nodes),
                                           .drawables = std::move(surrounding.drawables),
                                           .placements = std::move(surrounding.placements),
                                           .transforms = std::move(surrounding.transforms),
                                           .instances = {}});
  pack.skeleton.sub_hierarchies.push_back(
      {.lattice = 2,
       .scene_nodes = {{.box = {{0, 0, 0}, {720, 80, 4}}, .first_child = 1, .child_count = 2},
                       {.box = {{0, 0, 0}, {320, 80, 4}}, .parent = 0},
                       {.box = {{400, 0, 0}, {720, 80, 4}}, .parent = 0}},
       .drawables = {},
       .placements = {},
       .transforms = {Affine(1), mirrored},
       .instances = {{.scene_node = 1, .sub_hierarchy = 0, .transform = 0, .stretch = 1},
                     {.scene_node = 2, .sub_hierarchy = 0, .transform = 1, .stretch = 1}}});
  const Affine turned = axes({0, 2, 0}, {-2, 0, 0}, {0, 0, 2}, {20, 0, 5});
  const auto composed = [](const Affine& outer, const Affine& inner) { return outer * glm::dmat4(inner); };
  surrounding.transforms = {Affine(1),
                            turned,
                            axes({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {30, 0, 0}),
                            axes({1, 0, 0}, {0, 1, 0}, {0, 0, 4}, {30, 20, 0}),
                            composed(turned, moved),
                            composed(turned, mirrored),
                            composed(turned, composed(mirrored, moved))};
  surrounding.scene_nodes = {
      {.box = {{0, 0, 0}, {960, 1440, 48}}, .first_child = 1, .child_count = 3},
      {.box = {{0, 0, 40}, {160, 1440, 48}}, .parent = 0, .first_drawable = 0, .drawable_count = 1},
      {.box = {{240, 0, 0}, {960, 80, 4}}, .parent = 0},
      {.box = {{240, 160, 0}, {560, 240, 16}}, .parent = 0}};
  surrounding.placements = {{1, 1}, {1, 4}, {1, 5}, {1, 6}};
  surrounding.drawables = {
      {.error = 1, .scene_node = 1, .first_placement = 0, .placement_count = 4, .triangles = 8}};
  surrounding.placed_triangles = 5 * 256;
  pack.skeleton.instances = {{.scene_node = 1, .sub_hierarchy = 1, .transform = 1, .stretch = 2},
                             {.scene_node = 2, .sub_hierarchy = 1, .transform = 2, .stretch = 1},
                             {.scene_node = 3, .sub_hierarchy = 0, .transform = 3, .stretch = 4}};
  return pack;
}

inline std::filesystem::path write_pack(const InstancedPack& pack) {
  return write_pack(pack.chunks, pack.chunk_lattices, pack.skeleton);
}

}  // namespace triptych::test
