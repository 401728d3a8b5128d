// The section BODY: what is written is read when the pack is opened, how far bodies reach, and damage is one
// error.
#include "scene/closed_surfaces.hpp"

#include "base/bytes.hpp"
#include "preprocess/build.hpp"
#include "preprocess/pack_writer.hpp"
#include "tests/support/awkward_meshes.hpp"
#include "tests/support/pack_bytes.hpp"
#include "tests/support/small_pack.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

using namespace test;

/// Three chunks of 9 triangles, on one lattice.
std::vector<ChunkInfo> chunks() {
  return std::vector<ChunkInfo>(3, ChunkInfo{.vertex_count = 9, .triangle_count = 9, .box = {}});
}

/// A chunk has two triangles alone, and a body two runs.
ClosedSurfaces example() {
  ClosedSurfaces closed;
  closed.in_chunks = {0, 2, 0};
  closed.bodies = {{.box = {{-1, -2, -3}, {1, 2, 3}}, .first_run = 0, .run_count = 2}};
  closed.runs = {{.chunk = 0, .first_triangle = 0, .triangle_count = 9, .body = 0},
                 {.chunk = 1, .first_triangle = 2, .triangle_count = 7, .body = 0}};
  return closed;
}

std::string decode_error(const ClosedSurfaces& closed, std::vector<ChunkInfo> infos = chunks()) {
  try {
    decode_closed_surfaces(encode_closed_surfaces(closed), infos, "here");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(ClosedSurfaces, are_read_as_they_were_written) {
  const ClosedSurfaces read = decode_closed_surfaces(encode_closed_surfaces(example()), chunks(), "here");
  EXPECT_EQ(read.in_chunks, example().in_chunks);
  EXPECT_EQ(read.bodies, example().bodies);
  EXPECT_EQ(read.runs, example().runs);
  EXPECT_TRUE(decode_closed_surfaces(encode_closed_surfaces({}), chunks(), "here").empty());
}

TEST(ClosedSurfaces, that_cannot_be_are_errors) {
  EXPECT_EQ(decode_error(example()), "");
  const auto error_after = [](const auto& change) {
    ClosedSurfaces closed = example();
    change(closed);
    return decode_error(closed);
  };
  EXPECT_NE(error_after([](auto& c) { c.in_chunks[1] = 10; }), "") << "more than the chunk has";
  EXPECT_NE(error_after([](auto& c) { c.in_chunks.push_back(1); }), "") << "no such chunk";
  EXPECT_NE(error_after([](auto& c) { c.in_chunks[1] = 3; }), "") << "a triangle twice";
  EXPECT_NE(error_after([](auto& c) { c.runs[1].first_triangle = 3; }), "") << "more than are left";
  EXPECT_NE(error_after([](auto& c) { c.runs[1].first_triangle = 9; }), "");
  EXPECT_NE(error_after([](auto& c) { c.runs[1].triangle_count = 0; }), "");
  EXPECT_NE(error_after([](auto& c) { c.runs[1].chunk = 3; }), "");
  EXPECT_NE(error_after([](auto& c) { std::swap(c.runs[0], c.runs[1]); }), "") << "chunks ascend";
  EXPECT_NE(error_after([](auto& c) { c.bodies[0].run_count = 0; }), "");
  EXPECT_NE(error_after([](auto& c) { c.bodies[0].box.hi.x = -2; }), "") << "an empty box";
  EXPECT_NE(error_after([](auto& c) { c.bodies[0].box.hi.x = 1 << 30; }), "");
  EXPECT_NE(error_after([](auto& c) {
              c.bodies.push_back({.box = c.bodies[0].box, .first_run = 1, .run_count = 1});
            }),
            "")
      << "two bodies with the same triangles";
  std::vector<ChunkInfo> other_lattice = chunks();
  other_lattice[1].lattice = 1;
  EXPECT_NE(decode_error(example(), other_lattice), "");
  std::vector<std::byte> longer = encode_closed_surfaces(example());
  longer.push_back({});
  EXPECT_THROW(decode_closed_surfaces(longer, chunks(), "here"), Error);
}

/// A ball in many parts and a box by itself.
Pack ball_and_box() {
  const auto file = std::filesystem::path(testing::TempDir()) / "triptych_closed_surfaces.tpk";
  build_pack(awkward::model_of({awkward::sphere(24, 3), awkward::box({9, 0, 0}, {10, 1, 1})}),
             {.part_triangles = 64, .leaf_triangles = 64}, file);
  return Pack(file);
}

TEST(ClosedSurfaces, reach_as_far_as_the_bodies_that_nodes_show_a_part_of) {
  const Pack pack = ball_and_box();
  const Skeleton& skeleton = pack.skeleton();
  ASSERT_EQ(skeleton.closed.bodies.size(), 1u);
  const LatticeBox ball = placed_body(skeleton, skeleton.closed.bodies[0], Affine(1));
  size_t far_reaching = 0;
  for (SceneNodeId id = 0; id < skeleton.scene_nodes.size(); ++id) {
    const SceneNode& node = skeleton.scene_nodes[id];
    const LatticeBox& reach = skeleton.closed.reach(id, node);
    EXPECT_TRUE(reach.contains(node.box));
    if (node.child_count > 0) continue;
    const Placement& shown = skeleton.placements[skeleton.drawables[node.first_drawable].first_placement];
    const bool of_ball = !skeleton.closed.runs_in(shown.chunk).empty();
    EXPECT_EQ(reach.contains(ball), of_ball);
    EXPECT_EQ(reach == node.box, !of_ball);
    far_reaching += of_ball;
  }
  EXPECT_EQ(far_reaching, skeleton.closed.runs.size());
  for (uint32_t chunk = 0; chunk < skeleton.chunks.size(); ++chunk) {
    const uint32_t alone = skeleton.closed.in_chunk(chunk);
    EXPECT_TRUE(alone == 0 || alone == 12) << "the box";
  }
}

TEST(ClosedSurfaces, are_covered_by_the_content_hash_and_their_damage_is_one_error) {
  const auto file = write_pack(small_pack());
  const uint64_t without = Pack(file).content_hash();
  SmallPack small = small_pack();
  PackWriter writer(file);
  for (size_t i = 0; i < small.chunks.size(); ++i) writer.add_chunk(small.chunks[i], small.chunk_lattices[i]);
  small.skeleton.closed.in_chunks.assign(small.chunks.size(), 1);
  writer.finish(small.skeleton);
  EXPECT_NE(Pack(file).content_hash(), without);
  EXPECT_EQ(Pack(file).skeleton().closed.in_chunk(0), 1u);
  const std::string whole = read_text_file(file);
  const size_t entry = value_at<uint64_t>(whole, 16) + 2 * section_bytes;
  ASSERT_EQ(whole.substr(entry, 4), "BODY");
  const auto begin = value_at<uint64_t>(whole, entry + 8), size = value_at<uint64_t>(whole, entry + 16);
  for (uint64_t i = begin; i < begin + size; ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 1);
    std::ofstream(file, std::ios::binary) << damaged;
    EXPECT_NE(error_of(file).find("section BODY: byte"), std::string::npos) << i;
  }
}

}  // namespace
}  // namespace triptych
