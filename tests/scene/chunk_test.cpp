#include "scene/chunk.hpp"

#include "base/error.hpp"
#include "preprocess/encode_chunk.hpp"
#include "simplify/surface.hpp"
#include "tests/support/small_pack.hpp"

#include <algorithm>
#include <cstring>
#include <gtest/gtest.h>
#include <random>
#include <set>

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
      corners[k] = {vertex.point.x, vertex.point.y, vertex.point.z, static_cast<int>(+vertex.color)};
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

/// As a reader of a pack that holds the chunk decodes bytes.
Chunk decoded(const Chunk& chunk, std::span<const std::byte> bytes, const ChunkInfo& info, size_t palette) {
  const std::vector<LatticeBox> pieces = chunk.pieces();
  return decode_chunk(bytes, info, pieces.empty() ? std::span(&info.box, 1) : std::span(pieces), palette,
                      "chunk");
}

Chunk random_chunk(unsigned seed, size_t vertices, size_t triangles) {
  std::mt19937 random(seed);
  Chunk chunk;
  for (size_t i = 0; i < vertices; ++i) {
    const auto coordinate = [&] {
      return static_cast<int>(random() % (2u * Lattice::limit)) - Lattice::limit;
    };
    chunk.vertices.push_back(
        {{coordinate(), coordinate(), coordinate()}, static_cast<uint32_t>(random() % 7) & 0xfffffu});
  }
  for (size_t i = 0; i < 3 * triangles; ++i)
    chunk.indices.push_back(static_cast<uint32_t>(i < vertices ? i : random() % vertices));
  return chunk;
}

/// A random one and, 100 steps aside, its twin.
Chunk two_pieces(unsigned seed) {
  Chunk chunk = random_chunk(seed, 30, 40);
  const auto count = static_cast<uint32_t>(chunk.vertices.size());
  for (uint32_t i = 0; i < count; ++i) {
    chunk.vertices[i].point /= 2;
    ChunkVertex twin = chunk.vertices[i];
    twin.point.x += 100;
    twin.piece = 1;
    chunk.vertices.push_back(twin);
  }
  for (size_t i = 0, end = chunk.indices.size(); i < end; ++i)
    chunk.indices.push_back(chunk.indices[i] + count);
  return chunk;
}

TEST(Chunk, what_is_encoded_is_shown_again_with_its_winding) {
  for (const Chunk& chunk : {test::grid_chunk({-5, 3, 7}, 20, 3, 2, 1), random_chunk(1, 3, 1),
                             random_chunk(2, 300, 500), random_chunk(3, 5000, 1700)}) {
    const Chunk again = decoded(chunk, encode_chunk(chunk), info_of(chunk), 7);
    EXPECT_EQ(shown(again), shown(chunk));
  }
}

TEST(Chunk, what_is_outward_is_known_again_triangle_by_triangle) {
  Chunk chunk = test::grid_chunk({-5, 3, 7}, 4, 3, 2, 1);
  const auto first = static_cast<uint32_t>(chunk.vertices.size());
  for (const glm::ivec3& point : {glm::ivec3(0, 0, 20), {5, 0, 20}, {0, 5, 20}, {0, 0, 25}})
    chunk.vertices.push_back({.point = point, .color = 2, .piece = 0});
  for (const uint32_t index : {0u, 2u, 1u, 0u, 1u, 3u, 1u, 2u, 3u, 2u, 0u, 3u})
    chunk.indices.push_back(first + index);
  const Chunk again = decoded(chunk, encode_chunk(chunk), info_of(chunk), 7);
  const std::vector<bool> outward = again.outward();
  ASSERT_EQ(outward.size(), again.triangle_count());
  for (size_t i = 0; i < again.triangle_count(); ++i)
    EXPECT_EQ(outward[i], again.vertices[again.indices[3 * i]].color == 2) << i;
}

TEST(Chunk, runs_that_do_not_ascend_or_end_beyond_the_triangles_are_refused) {
  Chunk chunk;
  for (const glm::ivec3& point : {glm::ivec3(0, 0, 20), {5, 0, 20}, {0, 5, 20}, {0, 0, 25}})
    chunk.vertices.push_back({.point = point, .color = 2, .piece = 0});
  chunk.indices = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
  const auto bytes = encode_chunk(chunk);
  constexpr size_t second_end =
      16;  // behind the counts of vertices, triangles and runs, and the first run's end
  ASSERT_EQ(std::to_integer<int>(bytes[second_end]), 4);
  EXPECT_NO_THROW(decoded(chunk, bytes, info_of(chunk), 7));
  for (const int end : {0, 5, 255}) {
    auto damaged = bytes;
    damaged[second_end] = static_cast<std::byte>(end);
    EXPECT_THROW(decoded(chunk, damaged, info_of(chunk), 7), Error) << end;
  }
}

TEST(Chunk, degenerate_triangles_stay) {
  Chunk chunk = test::grid_chunk({0, 0, 0}, 1, 1);
  chunk.indices.insert(chunk.indices.end(), {0, 0, 1, 2, 2, 2});
  EXPECT_EQ(shown(decoded(chunk, encode_chunk(chunk), info_of(chunk), 1)), shown(chunk));
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
    EXPECT_THROW(decoded(chunk, bytes, info, palette), Error);
  };
  refused([](ChunkInfo& info) { ++info.vertex_count; }, 7);
  refused([](ChunkInfo& info) { --info.triangle_count; }, 7);
  refused([](ChunkInfo& info) { ++info.box.lo.y; }, 7);
  refused([](ChunkInfo& info) { --info.box.hi.z; }, 7);
  refused([](ChunkInfo&) {}, 3);
}

TEST(Chunk, pieces_are_boxes_of_their_vertices_and_come_back) {
  const Chunk chunk = two_pieces(7);
  const std::vector<LatticeBox> pieces = chunk.pieces();
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_EQ(pieces[1].lo, pieces[0].lo + glm::ivec3(100, 0, 0));
  EXPECT_EQ(pieces[1].hi, pieces[0].hi + glm::ivec3(100, 0, 0));
  const Chunk again = decoded(chunk, encode_chunk(chunk), info_of(chunk), 7);
  EXPECT_EQ(shown(again), shown(chunk));
  EXPECT_EQ(again.pieces(), pieces);
  EXPECT_TRUE(random_chunk(8, 30, 40).pieces().empty());
}

TEST(Chunk, vertices_outside_their_piece_pieces_that_are_missing_and_triangles_across_are_refused) {
  const Chunk chunk = two_pieces(9);
  const auto refused = [&](const Chunk& stored, std::vector<LatticeBox> pieces) {
    EXPECT_THROW(decode_chunk(encode_chunk(stored), info_of(stored), pieces, 7, "chunk"), Error);
  };
  std::vector<LatticeBox> pieces = chunk.pieces();
  EXPECT_NO_THROW(decode_chunk(encode_chunk(chunk), info_of(chunk), pieces, 7, "chunk"));
  refused(chunk, {chunk.box()});
  refused(chunk, {pieces[1], pieces[0]});
  --pieces[1].hi.x;
  refused(chunk, pieces);
  Chunk across = chunk;
  std::swap(across.indices.front(), across.indices.back());
  refused(across, chunk.pieces());
}

TEST(Chunk, damaged_bytes_are_refused_or_give_a_chunk_that_is_safe_to_draw) {
  const Chunk chunk = two_pieces(6);
  const auto bytes = encode_chunk(chunk);
  const ChunkInfo info = info_of(chunk);
  for (size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_THROW(decoded(chunk, std::span(bytes).first(length), info, 7), Error) << length;
  }
  for (size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    auto damaged = bytes;
    damaged[bit / 8] ^= std::byte{1} << (bit % 8);
    try {
      const Chunk again = decoded(chunk, damaged, info, 7);
      for (const uint32_t index : again.indices) ASSERT_LT(index, again.vertices.size());
      for (const ChunkVertex& vertex : again.vertices) ASSERT_LT(vertex.piece, 2u);
      ASSERT_TRUE(info.box.contains(again.box()));
    } catch (const Error&) {
    }
  }
}

TEST(Chunk, a_point_has_one_vertex_for_each_of_its_colours_and_pieces) {
  std::mt19937 engine(9);
  const auto random = [&](uint32_t below) { return static_cast<uint32_t>(engine() % below); };
  Surface surface;
  std::vector<uint8_t> pieces;
  for (int i = 0; i < 40; ++i) surface.points.push_back({i, i * i % 17, i * 7 % 5});
  std::set<std::array<uint32_t, 3>> distinct;
  for (int i = 0; i < 3000; ++i) {
    const uint32_t hub = 3, a = 4 + random(36), b = 4 + random(36),
                   color = material_in_layer(random(200), random(3));
    surface.triangles.push_back({{hub, a, b}, color});
    pieces.push_back(static_cast<uint8_t>(random(3)));
    for (const uint32_t point : {hub, a, b}) distinct.insert({point, color, pieces.back()});
  }
  const Chunk chunk = make_chunk(surface, pieces);
  EXPECT_EQ(chunk.vertices.size(), distinct.size());
  ASSERT_EQ(chunk.indices.size(), 3 * surface.triangles.size());
  for (size_t i = 0; i < chunk.indices.size(); ++i) {
    const Triangle& triangle = surface.triangles[i / 3];
    const ChunkVertex expected{surface.points[triangle.vertices[i % 3]], triangle.material & 0xfffffu,
                               layer_of(triangle.material) & 15u, pieces[i / 3]};
    EXPECT_EQ(chunk.vertices[chunk.indices[i]], expected) << i;
  }
}

/// A colour for each vertex that says which one it is.
Chunk colored(Chunk chunk) {
  for (size_t i = 0; i < chunk.vertices.size(); ++i)
    chunk.colors.push_back({static_cast<uint8_t>(i), static_cast<uint8_t>(i >> 8), 7, 255});
  return chunk;
}

TEST(Chunk, colours_of_vertices_come_back_with_their_vertices) {
  const Chunk chunk = colored(random_chunk(5, 700, 900));
  const Chunk again = decoded(chunk, encode_chunk(chunk), info_of(chunk), 7);
  ASSERT_EQ(again.colors.size(), again.vertices.size());
  for (size_t i = 0; i < again.vertices.size(); ++i) {
    const size_t before = again.colors[i][0] + size_t{256} * again.colors[i][1];
    EXPECT_EQ(again.vertices[i], chunk.vertices[before]);
    EXPECT_EQ(again.colors[i], chunk.colors[before]);
  }
}

/// A place on a texture for each vertex that says which one it is.
Chunk textured(Chunk chunk) {
  for (size_t i = 0; i < chunk.vertices.size(); ++i)
    chunk.coordinates.push_back({static_cast<int32_t>(i), -static_cast<int32_t>(70000 * i)});
  return chunk;
}

TEST(Chunk, places_on_textures_come_back_with_their_vertices_beside_colours_or_alone) {
  for (const bool with_colors : {false, true}) {
    Chunk chunk = textured(random_chunk(5, 700, 900));
    if (with_colors) chunk = colored(chunk);
    const Chunk again = decoded(chunk, encode_chunk(chunk), info_of(chunk), 7);
    ASSERT_EQ(again.coordinates.size(), again.vertices.size());
    EXPECT_EQ(again.colors.size(), with_colors ? again.vertices.size() : 0);
    for (size_t i = 0; i < again.vertices.size(); ++i) {
      const auto before = static_cast<size_t>(again.coordinates[i].u);
      EXPECT_EQ(again.vertices[i], chunk.vertices[before]);
      EXPECT_EQ(again.coordinates[i], chunk.coordinates[before]);
      if (with_colors) {
        EXPECT_EQ(again.colors[i], chunk.colors[before]);
      }
    }
  }
}

TEST(Chunk, streams_in_another_order_or_twice_are_refused) {
  const Chunk chunk = textured(test::grid_chunk({0, 0, 0}, 4, 3));
  auto bytes = encode_chunk(chunk);
  uint32_t runs = 0, positions = 0, coordinates = 0;
  std::memcpy(&runs, bytes.data() + 8, sizeof(runs));
  std::memcpy(&positions, bytes.data() + 12 + 4 * size_t{runs}, sizeof(positions));
  const size_t kind = 16 + 4 * size_t{runs} + positions;
  ASSERT_EQ(std::to_integer<int>(bytes[kind]), chunk_coordinates_stream);
  std::memcpy(&coordinates, bytes.data() + kind + 1, sizeof(coordinates));
  const auto at = [&](size_t byte) { return bytes.begin() + static_cast<std::ptrdiff_t>(byte); };
  const std::vector<std::byte> stream(at(kind), at(kind + 5 + coordinates));
  bytes.insert(at(kind), stream.begin(), stream.end());
  EXPECT_THROW(decoded(chunk, bytes, info_of(chunk), 7), Error);
}

TEST(Chunk, without_colours_the_bytes_hold_none) {
  const Chunk chunk = random_chunk(5, 700, 900);
  EXPECT_TRUE(decoded(chunk, encode_chunk(chunk), info_of(chunk), 7).colors.empty());
  EXPECT_LT(encode_chunk(chunk).size(), encode_chunk(colored(chunk)).size());
}

TEST(Chunk, damaged_streams_of_colours_are_refused) {
  const Chunk chunk = colored(test::grid_chunk({0, 0, 0}, 4, 3));
  const auto bytes = encode_chunk(chunk);
  uint32_t runs = 0, positions = 0;
  std::memcpy(&runs, bytes.data() + 8, sizeof(runs));
  std::memcpy(&positions, bytes.data() + 12 + 4 * size_t{runs}, sizeof(positions));
  const size_t kind = 16 + 4 * size_t{runs} + positions;
  ASSERT_EQ(std::to_integer<int>(bytes[kind]), chunk_colors_stream);
  EXPECT_NO_THROW(decoded(chunk, bytes, info_of(chunk), 7));
  // An unknown kind, a size beyond the end, a size that is too small, another codec.
  for (const auto& [at, value] : {std::pair{kind, 9}, {kind + 4, 255}, {kind + 1, 1}, {kind + 5, 3}}) {
    auto damaged = bytes;
    damaged[at] = static_cast<std::byte>(value);
    EXPECT_THROW(decoded(chunk, damaged, info_of(chunk), 7), Error) << at;
  }
  for (size_t size = kind; size < bytes.size(); ++size)
    EXPECT_THROW(decoded(chunk, std::span(bytes).first(size), info_of(chunk), 7), Error) << size;
}

TEST(DecodeChunk, normals_come_back_beside_colours_and_damage_to_them_is_refused) {
  Chunk chunk = colored(test::grid_chunk({0, 0, 0}, 4, 3));
  for (size_t i = 0; i < chunk.vertices.size(); ++i)
    chunk.normals.push_back({static_cast<uint16_t>(900 + i), static_cast<uint16_t>(1100 - i)});
  chunk.normals_from = ChunkNormals::of_files;
  const Chunk back = decoded(chunk, encode_chunk(chunk), info_of(chunk), 7);
  EXPECT_EQ(back.normals_from, ChunkNormals::of_files);
  std::vector<VertexNormal> before = chunk.normals, after = back.normals;
  std::sort(before.begin(), before.end());
  std::sort(after.begin(), after.end());
  EXPECT_EQ(before, after);
  EXPECT_EQ(back.colors.size(), back.vertices.size());
  for (const VertexNormal& damaged : {VertexNormal{}, {0, 5}, {3000, 5}, {5, 0}}) {
    Chunk other = chunk;
    other.normals[5] = damaged;  // of some corners of its triangles; or out of range
    EXPECT_THROW(decoded(other, encode_chunk(other), info_of(other), 7), Error) << damaged[0];
  }
}

TEST(MakeChunk, a_point_with_two_normals_becomes_two_vertices) {
  Surface surface{.points = {{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {8, 8, 0}},
                  .triangles = {{{0, 1, 2}, 0}, {{2, 1, 3}, 0}}};
  constexpr VertexNormal up{1024, 1024}, aside{1500, 1024};
  surface.normals = {{up, up, up}, {up, aside, aside}};
  const Chunk chunk = make_chunk(surface);
  EXPECT_EQ(chunk.normals_from, ChunkNormals::of_levels);
  EXPECT_EQ(chunk.vertices.size(), 5u);
  ASSERT_EQ(chunk.normals.size(), 5u);
  for (size_t t = 0; t < 2; ++t) {
    for (size_t k = 0; k < 3; ++k) EXPECT_EQ(chunk.normals[chunk.indices[3 * t + k]], surface.normals[t][k]);
  }
}

TEST(MakeChunk, a_point_with_two_colours_becomes_two_vertices) {
  Surface surface{.points = {{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {8, 8, 0}},
                  .triangles = {{{0, 1, 2}, 0}, {{2, 1, 3}, 0}}};
  constexpr VertexColor red{255, 0, 0, 255}, blue{0, 0, 255, 255};
  surface.colors = {CornerColors{red, red, red}, CornerColors{red, blue, blue}};
  const Chunk chunk = make_chunk(surface);
  EXPECT_EQ(chunk.vertices.size(), 5u);
  ASSERT_EQ(chunk.colors.size(), 5u);
  for (size_t t = 0; t < 2; ++t) {
    for (size_t k = 0; k < 3; ++k)
      EXPECT_EQ(chunk.colors[chunk.indices[3 * t + k]], surface.colors[t][k].color);
  }
}

TEST(MakeChunk, a_point_with_two_places_on_textures_becomes_two_vertices) {
  Surface surface{.points = {{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {8, 8, 0}},
                  .triangles = {{{0, 1, 2}, 0}, {{2, 1, 3}, 0}}};
  surface.colors.resize(2);
  for (size_t t = 0; t < 2; ++t)
    for (size_t k = 0; k < 3; ++k)
      surface.colors[t][k].coordinates = {
          static_cast<int32_t>(surface.triangles[t].vertices[k]),
          surface.triangles[t].vertices[k] == 1 ? static_cast<int32_t>(t) : 0};
  const Chunk chunk = make_chunk(surface);
  EXPECT_EQ(chunk.vertices.size(), 5u);
  EXPECT_TRUE(chunk.colors.empty());
  ASSERT_EQ(chunk.coordinates.size(), 5u);
  for (size_t t = 0; t < 2; ++t) {
    for (size_t k = 0; k < 3; ++k)
      EXPECT_EQ(chunk.coordinates[chunk.indices[3 * t + k]], surface.colors[t][k].coordinates);
  }
}

}  // namespace
}  // namespace triptych
