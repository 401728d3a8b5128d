#include "scene/chunk.hpp"

#include "base/error.hpp"
#include "tests/support/small_pack.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <random>

namespace triptych {
namespace {

/// The triangles as points, each turned to begin with its least corner, sorted: what a chunk shows, in no
/// order.
std::vector<std::array<std::array<int, 4>, 3>> shown(const Chunk& chunk) {
  std::vector<std::array<std::array<int, 4>, 3>> triangles;
  for (size_t i = 0; i < chunk.indices.size(); i += 3) {
    std::array<std::array<int, 4>, 3> corners;
    for (size_t k = 0; k < 3; ++k) {
      const ChunkVertex& vertex = chunk.vertices[chunk.indices[i + k]];
      corners[k] = {vertex.point.x, vertex.point.y, vertex.point.z, static_cast<int>(vertex.color)};
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    triangles.push_back(corners);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

ChunkInfo info_of(const Chunk& chunk) {
  return {.vertex_count = static_cast<uint32_t>(chunk.vertices.size()),
          .triangle_count = static_cast<uint32_t>(chunk.triangle_count()),
          .box = chunk.box()};
}

Chunk random_chunk(unsigned seed, size_t vertices, size_t triangles) {
  std::mt19937 random(seed);
  Chunk chunk;
  for (size_t i = 0; i < vertices; ++i) {
    const auto coordinate = [&] {
      return static_cast<int>(random() % (2u * Lattice::limit)) - Lattice::limit;
    };
    chunk.vertices.push_back(
        {{coordinate(), coordinate(), coordinate()}, static_cast<uint32_t>(random() % 7)});
  }
  for (size_t i = 0; i < 3 * triangles; ++i)
    chunk.indices.push_back(static_cast<uint32_t>(i < vertices ? i : random() % vertices));
  return chunk;
}

TEST(Chunk, what_is_encoded_is_shown_again_with_its_winding) {
  for (const Chunk& chunk : {test::grid_chunk({-5, 3, 7}, 20, 3, 2, 1), random_chunk(1, 3, 1),
                             random_chunk(2, 300, 500), random_chunk(3, 5000, 1700)}) {
    const Chunk decoded = decode_chunk(encode_chunk(chunk), info_of(chunk), 7, "chunk");
    EXPECT_EQ(shown(decoded), shown(chunk));
  }
}

TEST(Chunk, degenerate_triangles_stay) {
  Chunk chunk = test::grid_chunk({0, 0, 0}, 1, 1);
  chunk.indices.insert(chunk.indices.end(), {0, 0, 1, 2, 2, 2});
  EXPECT_EQ(shown(decode_chunk(encode_chunk(chunk), info_of(chunk), 1, "chunk")), shown(chunk));
}

TEST(Chunk, the_same_chunk_has_the_same_bytes) {
  EXPECT_EQ(encode_chunk(random_chunk(4, 900, 2000)), encode_chunk(random_chunk(4, 900, 2000)));
}

TEST(Chunk, other_counts_than_promised_a_small_box_and_a_small_palette_are_refused) {
  const Chunk chunk = random_chunk(5, 30, 40);
  const auto bytes = encode_chunk(chunk);
  const auto refused = [&](auto&& change, size_t palette) {
    ChunkInfo info = info_of(chunk);
    change(info);
    EXPECT_THROW(decode_chunk(bytes, info, palette, "chunk"), Error);
  };
  refused([](ChunkInfo& info) { ++info.vertex_count; }, 7);
  refused([](ChunkInfo& info) { --info.triangle_count; }, 7);
  refused([](ChunkInfo& info) { ++info.box.lo.y; }, 7);
  refused([](ChunkInfo& info) { --info.box.hi.z; }, 7);
  refused([](ChunkInfo&) {}, 3);
}

TEST(Chunk, damaged_bytes_are_refused_or_give_a_chunk_that_is_safe_to_draw) {
  const Chunk chunk = random_chunk(6, 60, 80);
  const auto bytes = encode_chunk(chunk);
  const ChunkInfo info = info_of(chunk);
  for (size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_THROW(decode_chunk(std::span(bytes).first(length), info, 7, "chunk"), Error) << length;
  }
  for (size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    auto damaged = bytes;
    damaged[bit / 8] ^= std::byte{1} << (bit % 8);
    try {
      const Chunk decoded = decode_chunk(damaged, info, 7, "chunk");
      for (const uint32_t index : decoded.indices) ASSERT_LT(index, decoded.vertices.size());
      ASSERT_TRUE(info.box.contains(decoded.box()));
    } catch (const Error&) {
    }
  }
}

}  // namespace
}  // namespace triptych
