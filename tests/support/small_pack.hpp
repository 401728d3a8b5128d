// A small pack made by hand: a root over two leaves, for tests that need a pack whose every value is known.
#pragma once

#include "preprocess/pack_writer.hpp"

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <gtest/gtest.h>
#include <map>

namespace triptych::test {

/// A flat grid of cells × cells squares in the lattice's xy plane; the middle vertices lifted by `lift`.
inline Chunk grid_chunk(const glm::ivec3& origin, int cells, int cell, int lift = 0, uint32_t color = 0) {
  Chunk chunk;
  for (int y = 0; y <= cells; ++y) {
    for (int x = 0; x <= cells; ++x) {
      const bool inner = x > 0 && y > 0 && x < cells && y < cells;
      chunk.vertices.push_back({origin + glm::ivec3(x * cell, y * cell, inner ? lift : 0), color & 0xfffffu});
    }
  }
  for (int y = 0; y < cells; ++y) {
    for (int x = 0; x < cells; ++x) {
      const auto a = static_cast<uint32_t>(y * (cells + 1) + x), b = a + static_cast<uint32_t>(cells + 1);
      chunk.indices.insert(chunk.indices.end(), {a, a + 1, b, a + 1, b + 1, b});
    }
  }
  return chunk;
}

/// The same in two pieces: its first `triangles`, and the others.
inline Chunk cut_chunk(const Chunk& whole, size_t triangles) {
  Chunk chunk;
  std::map<std::pair<bool, uint32_t>, uint32_t> vertices;
  for (size_t i = 0; i < whole.indices.size(); ++i) {
    const bool second = i >= 3 * triangles;
    const auto next = static_cast<uint32_t>(chunk.vertices.size());
    const auto [found, inserted] = vertices.try_emplace({second, whole.indices[i]}, next);
    chunk.indices.push_back(found->second);
    if (!inserted) continue;
    chunk.vertices.push_back(whole.vertices[whole.indices[i]]);
    chunk.vertices.back().piece = second ? 1 : 0;
  }
  return chunk;
}

/// What small_pack() writes; tests change it on the way.
struct SmallPack {
  std::vector<Chunk> chunks;
  std::vector<uint32_t> chunk_lattices;
  Skeleton skeleton;
};

/// Lattice step 1/8. Leaf 1: a lifted grid of 8 × 8 squares and its simplification, a flat square (error 0.5:
/// the lift is 4 steps). Leaf 2: the same grid in two pieces, on a lattice of its own, turned and placed.
/// Root: both flat squares.
inline SmallPack small_pack() {
  SmallPack pack;
  Skeleton& skeleton = pack.skeleton;
  pack.chunks = {grid_chunk({0, 0, 0}, 8, 8, 4, 0), grid_chunk({0, 0, 0}, 1, 64, 0, 1),
                 cut_chunk(grid_chunk({0, 0, 0}, 8, 8, 4, 1), 64)};
  pack.chunk_lattices = {0, 0, 1};
  skeleton.lattices = {Lattice{{0, 0, 0}, 0.125}, Lattice{{1, 0, 0}, 0.0625}};
  skeleton.palette = {{200, 10, 10, 255}, {10, 200, 10, 255}};
  Affine turned(1);  // x → y, y → −x, twice as large, moved
  turned[0] = {0, 2, 0};
  turned[1] = {-2, 0, 0};
  turned[2] = {0, 0, 2};
  turned[3] = {40, 0, 0};
  Affine moved(1);
  moved[3] = {32, 2, 0};
  skeleton.transforms = {Affine(1), turned, moved};
  // Leaf 2: mesh x in 1..5, y in 0..4, z in 0..0.25 becomes x in 32..40, y in 2..10, z in 0..0.5.
  skeleton.scene_nodes = {
      {.box = {{0, 0, 0}, {320, 80, 4}},
       .first_child = 1,
       .child_count = 2,
       .first_drawable = 0,
       .drawable_count = 1},
      {.box = {{0, 0, 0}, {64, 64, 4}}, .parent = 0, .first_drawable = 1, .drawable_count = 2},
      {.box = {{256, 16, 0}, {320, 80, 4}}, .parent = 0, .first_drawable = 3, .drawable_count = 2}};
  skeleton.placements = {{1, 0}, {1, 2}, {0, 0}, {1, 0}, {2, 1}, {1, 2}};
  skeleton.drawables = {
      {.error = 0.5, .scene_node = 0, .first_placement = 0, .placement_count = 2, .triangles = 4},
      {.error = 0, .scene_node = 1, .first_placement = 2, .placement_count = 1, .triangles = 128},
      {.error = 0.5, .scene_node = 1, .first_placement = 3, .placement_count = 1, .triangles = 2},
      {.error = 0, .scene_node = 2, .first_placement = 4, .placement_count = 1, .triangles = 128},
      {.error = 0.5, .scene_node = 2, .first_placement = 5, .placement_count = 1, .triangles = 2}};
  skeleton.source_triangles = 256;
  skeleton.placed_triangles = 256;
  skeleton.objects = {2, 2, 2, 2};
  skeleton.import.dropped_triangles = 3;
  skeleton.import.warnings = {"scene.gltf: 1 textures are not drawn yet"};
  return pack;
}

/// Writes a pack under the running test's own name; tests that run on several devices side by side
/// have one each.
inline std::filesystem::path write_pack(const std::vector<Chunk>& chunks,
                                        const std::vector<uint32_t>& chunk_lattices,
                                        const StoredSkeleton& skeleton, const PackOptions& options = {}) {
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  const char* device = std::getenv("TRIPTYCH_TEST_DEVICE");
  const auto file =
      std::filesystem::path(testing::TempDir()) / (std::string("triptych_") + (device ? device : "") +
                                                   test->test_suite_name() + "_" + test->name() + ".tpk");
  PackWriter writer(file);
  const std::vector<bool>& seen = skeleton.surrounding.seen_from_outside;
  for (size_t i = 0; i < chunks.size(); ++i) {
    EncodedChunk chunk(chunks[i]);
    chunk.seen_from_outside = i < seen.size() && seen[i];
    writer.add_chunk(chunk, chunk_lattices[i]);
  }
  writer.finish(skeleton, {}, options);
  return file;
}

inline std::filesystem::path write_pack(const SmallPack& pack, const PackOptions& options = {}) {
  return write_pack(pack.chunks, pack.chunk_lattices, {pack.skeleton, {}, {}}, options);
}

}  // namespace triptych::test
