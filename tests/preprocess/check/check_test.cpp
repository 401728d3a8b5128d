#include "preprocess/check/check.hpp"

#include "base/error.hpp"
#include "preprocess/check/check_distances.hpp"
#include "preprocess/check/check_surfaces.hpp"
#include "tests/support/small_pack.hpp"

#include <array>
#include <atomic>
#include <fstream>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <random>

namespace triptych {
namespace {

using test::small_pack;
using test::SmallPack;
using test::write_pack;

CheckReport check(const SmallPack& pack) { return check_pack(Pack(write_pack(pack)), {.points = 100'000}); }

TEST(Check, a_sound_pack_passes_and_its_bounds_are_measured) {
  const CheckReport report = check(small_pack());
  EXPECT_TRUE(report.sound()) << (report.messages.empty() ? "" : report.messages[0]);
  EXPECT_EQ(report.drawables_checked, 5u);
  EXPECT_EQ(report.drawables_not_checked, 0u);
  EXPECT_TRUE(report.messages.empty());
  EXPECT_NEAR(report.bound_over_measured.p50, 1,
              1e-9);  // the lifted middle is 0.5 from the flat square, as promised
  EXPECT_NEAR(report.bound_over_measured.p95, 1, 1e-9);
}

TEST(Check, an_error_that_promises_too_much_is_found_on_leaves_instances_and_inner_nodes) {
  for (const DrawableId id : {0u, 2u, 4u}) {
    SmallPack pack = small_pack();
    pack.skeleton.drawables[id].error = 0.4999;
    const CheckReport report = check(pack);
    EXPECT_EQ(report.bound_violations, 1u) << id;
    ASSERT_FALSE(report.messages.empty());
    EXPECT_NE((report.messages[0] + report.messages.back()).find("drawable " + std::to_string(id)),
              std::string::npos);
  }
}

TEST(Check, a_larger_error_is_no_violation_but_shows_in_the_ratio) {
  SmallPack pack = small_pack();
  for (const DrawableId id : {0u, 2u, 4u}) pack.skeleton.drawables[id].error = 1.5;
  const CheckReport report = check(pack);
  EXPECT_TRUE(report.sound());
  EXPECT_NEAR(report.bound_over_measured.p50, 3, 1e-9);
}

TEST(Check, a_piece_that_vanished_is_found_though_what_is_left_lies_on_the_source) {
  SmallPack pack = small_pack();
  pack.skeleton.drawables[0].placement_count = 1;  // the root forgets the second leaf
  pack.skeleton.drawables[0].triangles /= 2;
  EXPECT_EQ(check(pack).bound_violations, 1u);
}

TEST(Check, a_piece_that_the_source_does_not_have_is_found) {
  SmallPack pack = small_pack();
  pack.skeleton.drawables[2].first_placement = 1;  // leaf 1's simplification stands where leaf 2 is
  const CheckReport report = check(pack);
  EXPECT_EQ(report.bound_violations, 1u);
  EXPECT_EQ(report.box_violations, 1u);
}

TEST(Check, a_shrunk_box_is_found) {
  SmallPack pack = small_pack();
  pack.skeleton.scene_nodes[1].box.hi.z = 3;
  EXPECT_EQ(check(pack).box_violations, 1u);
  pack = small_pack();
  pack.skeleton.scene_nodes[2].box.lo.x += 1;  // holds the placed instance and its simplification
  EXPECT_EQ(check(pack).box_violations, 2u);
}

TEST(Check, a_box_that_leaves_its_parents_is_found) {
  SmallPack pack = small_pack();
  pack.skeleton.scene_nodes[2].box.hi.x = 321;
  const CheckReport report = check(pack);
  EXPECT_EQ(report.box_violations, 1u);
  EXPECT_EQ(report.bound_violations, 0u);
}

TEST(Check, an_error_that_shrinks_is_found_along_a_node_and_towards_the_root) {
  SmallPack pack = small_pack();
  pack.skeleton.drawables[1].error = 0.6;  // the next of the same node and the root promise 0.5
  EXPECT_EQ(check(pack).monotonicity_violations, 2u);
  pack = small_pack();
  pack.skeleton.drawables[2].error = 0.6;  // the root promises 0.5
  EXPECT_EQ(check(pack).monotonicity_violations, 1u);
}

TEST(Check, triangles_that_are_said_to_be_outward_and_are_not_are_found) {
  const SmallPack pack = small_pack();
  const auto file = write_pack(pack);
  PackWriter writer(file);
  for (size_t i = 0; i < pack.chunks.size(); ++i) {
    EncodedChunk chunk(pack.chunks[i]);
    if (i == 1) {  // two triangles of a flat square: a run of none, a run of two
      constexpr size_t runs = 8;
      chunk.bytes[runs] = std::byte{2};
      constexpr std::array lie = {std::byte{0}, std::byte{0}, std::byte{0}, std::byte{0},
                                  std::byte{2}, std::byte{0}, std::byte{0}, std::byte{0}};
      chunk.bytes.insert(chunk.bytes.begin() + runs + 4, lie.begin(), lie.end());
    }
    writer.add_chunk(chunk, pack.chunk_lattices[i]);
  }
  writer.finish(pack.skeleton);
  const CheckReport report = check_pack(Pack(file), {.points = 100'000});
  EXPECT_EQ(report.outward_violations, 1u);
  EXPECT_EQ(report.checksum_errors, 0u);
  EXPECT_FALSE(report.sound());
}

TEST(Check, surfaces_that_are_said_to_be_closed_and_are_not_are_found) {
  SmallPack pack = small_pack();
  pack.skeleton.closed.in_chunks.assign(pack.chunks.size(), 0);
  pack.skeleton.closed.in_chunks[1] = 2;  // the two triangles of a flat square
  EXPECT_EQ(check(pack).outward_violations, 1u);
  pack = small_pack();
  const LatticeBox everywhere{glm::ivec3(-(1 << 20)), glm::ivec3(1 << 20)};
  pack.skeleton.closed.bodies = {{.box = everywhere, .first_run = 0, .run_count = 1}};
  pack.skeleton.closed.runs = {{.chunk = 1, .first_triangle = 0, .triangle_count = 2, .body = 0}};
  const CheckReport report = check(pack);
  EXPECT_EQ(report.outward_violations, 1u);
  EXPECT_FALSE(report.sound());
}

void add_box(const glm::ivec3& lo, const glm::ivec3& hi, Chunk& chunk) {
  const auto first = static_cast<uint32_t>(chunk.vertices.size());
  for (int i = 0; i < 8; ++i)
    chunk.vertices.push_back({{i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z}, 0});
  for (const auto& [a, b, c, d] : std::array<std::array<uint32_t, 4>, 6>{
           {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}}) {
    for (const uint32_t corner : {a, b, c, a, c, d}) chunk.indices.push_back(first + corner);
  }
}

/// A square with a box of half a unit three units above it, which a level of error 0.5 leaves out, and a
/// shell so many lattice steps around that box, of an eighth of a unit, as another leaf.
SmallPack covered_pack(int apart, bool is_marked) {
  SmallPack pack;
  Chunk all = test::grid_chunk({0, 0, 0}, 1, 64), shell;
  const glm::ivec3 lo(30, 30, 24), hi(34, 34, 28);
  add_box(lo, hi, all);
  add_box(lo - apart, hi + apart, shell);
  pack.chunks = {all, test::grid_chunk({0, 0, 0}, 1, 64), shell};
  pack.chunk_lattices = {0, 0, 0};
  Skeleton& skeleton = pack.skeleton;
  skeleton.seen_from_outside = {false, is_marked, false};
  skeleton.lattices = {Lattice{{0, 0, 0}, 0.125}};
  skeleton.palette = {{200, 10, 10, 255}};
  skeleton.transforms = {Affine(1)};
  const LatticeBox sheet{{0, 0, 0}, {64, 64, 28}}, around{lo - apart, hi + apart};
  skeleton.scene_nodes = {{.box = {glm::min(sheet.lo, around.lo), glm::max(sheet.hi, around.hi)},
                           .first_child = 1,
                           .child_count = 2,
                           .first_drawable = 0,
                           .drawable_count = 0},
                          {.box = sheet, .parent = 0, .first_drawable = 0, .drawable_count = 2},
                          {.box = around, .parent = 0, .first_drawable = 2, .drawable_count = 1}};
  skeleton.placements = {{0, 0}, {1, 0}, {2, 0}};
  skeleton.drawables = {
      {.error = 0, .scene_node = 1, .first_placement = 0, .placement_count = 1, .triangles = 14},
      {.error = 0.5, .scene_node = 1, .first_placement = 1, .placement_count = 1, .triangles = 2},
      {.error = 0, .scene_node = 2, .first_placement = 2, .placement_count = 1, .triangles = 12}};
  skeleton.source_triangles = skeleton.placed_triangles = 26;
  return pack;
}

TEST(Check, a_level_may_leave_out_what_lies_right_beneath_others_where_it_is_marked) {
  for (const int apart : {1, 3}) {
    const CheckReport report = check(covered_pack(apart, true));
    EXPECT_TRUE(report.sound()) << report.messages.at(0);
  }
}

TEST(Check, a_level_that_leaves_out_what_others_cover_and_is_not_marked_is_found) {
  const CheckReport report = check(covered_pack(1, false));
  EXPECT_EQ(report.seen_violations, 1u);
  EXPECT_EQ(report.bound_violations, 0u);
  EXPECT_FALSE(report.sound());
  EXPECT_NE(report.messages.at(0).find("drawable 1 of scene node 1: leaves out what is at "),
            std::string::npos)
      << report.messages[0];
  EXPECT_NE(report.messages[0].find("is not marked in section SEEN"), std::string::npos);
}

TEST(Check, what_is_left_out_though_what_hides_it_is_far_away_is_found_marked_or_not) {
  for (const bool is_marked : {false, true}) {
    const CheckReport report = check(covered_pack(24, is_marked));  // three units
    EXPECT_EQ(report.seen_violations, 1u);
    EXPECT_EQ(report.bound_violations, 0u) << "nobody outside sees it";
    EXPECT_EQ(report.messages.at(0).find("nothing else is there") != std::string::npos, is_marked)
        << report.messages[0];
  }
}

TEST(Check, what_is_left_out_and_not_hidden_is_a_distance) {
  SmallPack pack = covered_pack(1, true);
  pack.skeleton.placements[2].chunk = 1;  // in place of the shell a square
  pack.skeleton.drawables[2].triangles = 2;
  const CheckReport report = check(pack);
  EXPECT_EQ(report.seen_violations, 0u);
  EXPECT_GE(report.bound_violations, 1u);
}

TEST(Check, a_damaged_chunk_is_counted_and_what_hangs_on_it_is_not_checked) {
  const auto file = write_pack(small_pack());
  uint64_t offset = 0;
  {
    const Pack pack(file);
    offset = 32 + pack.skeleton().chunks[2].offset + 40;
  }
  {
    std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
    bytes.seekg(static_cast<std::streamoff>(offset));
    const int old = bytes.get();
    bytes.seekp(static_cast<std::streamoff>(offset));
    bytes.put(static_cast<char>(old ^ 1));
  }
  const CheckReport report = check_pack(Pack(file));
  EXPECT_EQ(report.checksum_errors, 1u);
  EXPECT_EQ(report.bound_violations, 0u);
  EXPECT_GE(report.drawables_not_checked, 2u);  // leaf 2's simplification and the root
  ASSERT_EQ(report.messages.size(), 1u);
  EXPECT_NE(report.messages[0].find("chunk 2"), std::string::npos);
  EXPECT_FALSE(report.sound());
}

TEST(Check, says_the_same_twice_and_no_more_than_it_was_asked_for) {
  SmallPack pack = small_pack();
  for (Drawable& drawable : pack.skeleton.drawables) drawable.error = 0;
  const Pack opened(write_pack(pack));
  const CheckReport once = check_pack(opened, {.points = 10'000, .messages = 2}),
                    again = check_pack(opened, {.points = 10'000, .messages = 2});
  EXPECT_EQ(once.bound_violations, 3u);
  EXPECT_EQ(once.messages.size(), 2u);
  EXPECT_EQ(once.messages, again.messages);
}

TEST(Check, a_measurement_ends_when_it_is_told_to_before_or_in_the_middle_of_a_drawable) {
  SmallPack pack = small_pack();
  const Pack opened(write_pack(pack));
  const std::vector<DrawableId> all = {0, 1, 2, 3, 4};
  std::atomic<int> calls = 0;
  const std::vector<double> whole = measured_distances(opened, all, 10'000, [&] { ++calls; });
  const std::vector<MeasuredDrawable> measured = measured_drawables(opened, 10'000);
  for (size_t i = 0; i < whole.size(); ++i) EXPECT_EQ(whole[i], measured.at(i).distance);
  ASSERT_GE(calls, 5);
  for (int last = 0; last < calls; ++last) {
    std::atomic<int> left = last;
    const auto told = [&] {
      if (--left < 0) fail("check", "was told to end");
    };
    EXPECT_THROW(measured_distances(opened, all, 10'000, told), Error) << last;
  }
}

TEST(CheckSurfaces, the_distance_to_a_triangle_is_the_least_over_its_points) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  const auto any = [&] { return glm::dvec3(coordinate(random), coordinate(random), coordinate(random)); };
  for (int i = 0; i < 200; ++i) {
    const glm::dvec3 a = any(), b = any(),
                     c = i % 5 == 0   ? a
                         : i % 7 == 0 ? (a + b) * 0.5
                                      : any(),
                     point = any() * 2.0;
    double least = 1e9;
    constexpr int steps = 200;
    for (int u = 0; u <= steps; ++u) {
      for (int v = 0; u + v <= steps; ++v) {
        least = std::min(least,
                         glm::distance(point, a + (b - a) * (u * 1.0 / steps) + (c - a) * (v * 1.0 / steps)));
      }
    }
    const double distance = distance_to_triangle(point, a, b, c);
    EXPECT_LE(distance, least + 1e-12);
    EXPECT_GE(distance, least - 0.02);
  }
}

TEST(CheckSurfaces, the_tree_finds_what_a_full_search_finds_under_any_transform) {
  const Chunk chunk = test::grid_chunk({100'000'000, -5, 7}, 12, 9, 5);
  SmallPack pack = small_pack();
  pack.chunks[2] = chunk;
  pack.skeleton.drawables[3].triangles = static_cast<uint32_t>(chunk.triangle_count());
  Affine sheared(1);  // a shear, a mirror and a scale that differs along the axes
  sheared[0] = {0.5, 0.1, 0};
  sheared[1] = {0.7, -3, 0.2};
  sheared[2] = {0, 0.3, 8};
  sheared[3] = {-1234.5, 17, 1e5};
  pack.skeleton.transforms[1] = sheared;
  const Pack opened(write_pack(pack));
  const PackSurfaces surfaces(opened);
  const auto tree = surfaces.tree(2);
  const Lattice lattice = opened.skeleton().lattices[1];
  std::mt19937 random(9);
  std::uniform_real_distribution<double> jitter(-40, 40);
  for (int i = 0; i < 300; ++i) {
    const glm::dvec3 near =
        sheared * glm::dvec4(lattice.position(chunk.vertices[random() % chunk.vertices.size()].point), 1);
    const glm::dvec3 point =
        near + glm::dvec3(jitter(random), jitter(random), jitter(random)) * (i % 3 == 0 ? 1e-3 : 1.0);
    double least = 1e300;
    for (size_t k = 0; k < chunk.indices.size(); k += 3) {
      std::array<glm::dvec3, 3> corners;
      for (size_t j = 0; j < 3; ++j)
        corners[j] = sheared * glm::dvec4(lattice.position(chunk.vertices[chunk.indices[k + j]].point), 1);
      least = std::min(least, distance_to_triangle(point, corners[0], corners[1], corners[2]));
    }
    EXPECT_NEAR(tree->distance(surfaces.placing(1), point, 1e300, 0), least, 1e-11);
    EXPECT_EQ(tree->distance(surfaces.placing(1), point, least / 2, 0), least / 2);
  }
}

}  // namespace
}  // namespace triptych
