// Where surfaces touch: which points are in contact, what chains of levels they get, and how they are joined.
#include "preprocess/contacts/close_seams.hpp"
#include "preprocess/contacts/find_contacts.hpp"
#include "preprocess/contacts/hold_contacts.hpp"
#include "preprocess/contacts/small_contacts.hpp"
#include "preprocess/contacts/stitch.hpp"
#include "tests/preprocess/parts_scene.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <numeric>

namespace triptych {
namespace {

using test::step;

struct Scene : test::PartsScene {
  /// Each placed part is a leaf of its own, at the place of its number.
  FoundContacts found() const {
    std::vector<uint32_t> places(parts.hierarchies[0].placed.size());
    std::iota(places.begin(), places.end(), 0u);
    return find_contacts(parts, parts.hierarchies[0], places, file, 1 << 20,
                         PlacedCache(nullptr, parts, file));
  }
  std::vector<Contact> contacts() const { return found().contacts; }
  /// How many points of the one touch the other.
  size_t touching(uint32_t placed, uint32_t other) const {
    size_t points = 0;
    for (const Contact& contact : contacts())
      points += contact.placed == placed && contact.span.first <= other && other <= contact.span.last;
    return points;
  }
};

TEST(Contacts, boxes_side_by_side_touch_at_the_corners_of_their_common_face) {
  Scene scene;
  const uint32_t a = scene.add(awkward::box({0, 0, 0}, {1, 1, 1}));
  const uint32_t b = scene.add(awkward::box({1, 0, 0}, {2, 1, 1}));
  const uint32_t apart = scene.add(awkward::box({2.1, 0, 0}, {3, 1, 1}));
  EXPECT_EQ(scene.touching(a, b), 4u);
  EXPECT_EQ(scene.touching(b, a), 4u);
  EXPECT_EQ(scene.touching(b, apart), 0u);
  for (const Contact& contact : scene.contacts()) EXPECT_NEAR(contact.span.reach, std::sqrt(2) / step, 1);
}

TEST(Contacts, a_foot_within_a_floor_is_none_and_a_wall_at_its_rim_is_one) {
  Scene scene;
  const uint32_t floor = scene.add(awkward::box({0, -1, 0}, {8, 0, 8}));
  const uint32_t foot = scene.add(awkward::box({3, 0, 3}, {3.25, 1, 3.25}));
  const uint32_t wall = scene.add(awkward::box({2, 0, 0}, {6, 3, 0.25}));
  EXPECT_EQ(scene.touching(foot, floor), 0u);
  EXPECT_EQ(scene.touching(floor, foot), 0u);
  EXPECT_EQ(scene.touching(wall, floor), 2u) << "its outer edge lies on the floor's rim";
  EXPECT_EQ(scene.touching(floor, wall), 2u) << "the ends of that rim";
}

TEST(Contacts, files_of_single_precision_touch_within_a_few_steps) {
  Scene scene;
  const uint32_t a = scene.add(awkward::box({0, 0, 0}, {1, 1, 1}));
  const uint32_t near = scene.add(awkward::box({1 + 10 * step, 0, 0}, {2, 1, 1}));
  const uint32_t far = scene.add(awkward::box({0, 1 + 20 * step, 0}, {1, 2, 1}));
  EXPECT_EQ(scene.touching(a, near), 4u);
  EXPECT_EQ(scene.touching(a, far), 0u);
}

TEST(Seams, points_of_open_edges_become_one_and_those_of_closed_surfaces_stay) {
  const auto surface_of = [](std::vector<glm::ivec3> points, std::vector<std::array<uint32_t, 3>> corners) {
    Surface surface{.points = std::move(points), .triangles = {}};
    for (const auto& own : corners) surface.triangles.push_back({own, 0});
    return surface;
  };
  // Two triangles beside each other; one end of their common edge is 11 steps off, the other one 20.
  Surface open = surface_of({{0, 0, 0}, {900, 0, 0}, {0, 900, 0}, {911, 0, 0}, {0, 920, 0}, {900, 900, 0}},
                            {{0, 1, 2}, {3, 5, 4}});
  const ClosedSeams seams = close_seams(open, find_closed(open));
  EXPECT_EQ(seams.points, 1u);
  EXPECT_EQ(seams.moved, 11u);
  EXPECT_EQ(open.points.size(), 5u);
  EXPECT_EQ(open.triangles[1].vertices[0], open.triangles[0].vertices[1]);
  // A triangle of ten steps keeps its corners, and a closed surface all that is near it.
  Surface small = surface_of({{0, 0, 0}, {10, 0, 0}, {0, 10, 0}}, {{0, 1, 2}});
  EXPECT_EQ(close_seams(small, find_closed(small)).points, 0u);
  Surface closed = surface_of({{0, 0, 0}, {900, 0, 0}, {0, 900, 0}, {0, 0, 900}, {5, 5, 900}},
                              {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  closed.triangles.push_back({{4, 1, 2}, 0});
  EXPECT_EQ(close_seams(closed, find_closed(closed)).points, 0u);
}

TEST(Contacts, edges_within_a_smooth_surface_are_no_rims) {
  Scene scene;
  const Mesh sphere = awkward::sphere(24, 1);
  const uint32_t ball = scene.add(sphere);
  const auto& corners = sphere.triangles[sphere.triangles.size() / 2].vertices;
  const glm::dvec3 on_an_edge = (sphere.positions[corners[0]] + sphere.positions[corners[1]]) / 2.0;
  const auto needle_to = [&](const glm::dvec3& tip) {
    return scene.add(
        {.name = "needle",
         .positions = {tip, tip * 2.0 + glm::dvec3(0.1, 0, 0), tip * 2.0 - glm::dvec3(0.1, 0, 0)},
         .triangles = {{{0, 1, 2}, 0}}});
  };
  const uint32_t on_edge = needle_to(on_an_edge), on_point = needle_to(sphere.positions[corners[2]]);
  EXPECT_EQ(scene.touching(on_edge, ball), 0u) << "the ball goes on all around";
  EXPECT_EQ(scene.touching(ball, on_edge), 0u);
  EXPECT_EQ(scene.touching(ball, on_point), 1u) << "the needle ends there";
}

TEST(Contacts, of_any_number_of_objects_in_one_place_are_found_in_time) {
  Scene scene;
  const uint32_t box = scene.add_part(awkward::box({0, 0, 0}, {1, 1, 1}));
  for (int i = 0; i < 4'000; ++i) scene.place(box);
  const FoundContacts found = scene.found();
  EXPECT_EQ(found.crowded_parts, 4'000u - 33);
  EXPECT_EQ(found.contacts.size(), 4'000u * 8);
}

TEST(Contacts, large_boxes_that_touch_nothing_take_no_place_of_others) {
  Scene scene;
  const uint32_t a = scene.add(awkward::box({0, 0, 0}, {1, 1, 1})),
                 b = scene.add(awkward::box({1, 0, 0}, {2, 1, 1}));
  for (int i = 0; i < 100; ++i) {
    const double x = 0.01 * i;
    scene.add({.name = "cable",
               .positions = {{x, -9, -9}, {x, 9, 9}, {x + 0.001, 9, 9}},
               .triangles = {{{0, 1, 2}, 0}}});
  }
  EXPECT_EQ(scene.touching(a, b), 4u);
  EXPECT_EQ(scene.found().crowded_parts, 0u);
}

TEST(Contacts, of_what_is_no_larger_than_the_tolerance_are_none) {
  Scene scene;
  const uint32_t grain = scene.add(awkward::box({0, 0, 0}, {32 * step, 32 * step, 32 * step}));
  const uint32_t other = scene.add(awkward::box({32 * step, 0, 0}, {1, 1, 1}));
  EXPECT_EQ(scene.touching(grain, other), 0u);
  EXPECT_EQ(scene.touching(other, grain), 0u);
}

TEST(Contacts, a_part_placed_alone_and_in_contact_gets_two_chains) {
  Scene scene;
  const uint32_t box = scene.add_part(awkward::box({0, 0, 0}, {1, 1, 1}));
  for (const double x : {0.0, 1.0, 2.0, 9.0}) scene.place(box, {x, 0, 0});
  const uint32_t lone = scene.add(awkward::box({20, 0, 0}, {21, 1, 1}));
  const ContactReport report = hold_contacts(scene.parts, {scene.found()}, scene.file);
  EXPECT_EQ(report.held_parts, 1u);
  EXPECT_EQ(report.added_chains, 1u);
  ASSERT_EQ(scene.parts.parts.size(), 3u);
  EXPECT_EQ(scene.parts.parts[2].variant_of, box);
  EXPECT_EQ(scene.parts.parts[2].contacts.size(), 8u) << "of any of its placements";
  EXPECT_TRUE(scene.parts.parts[box].contacts.empty());
  std::vector<uint32_t> chains;
  for (const PlacedPart& placed : scene.hierarchy().placed) chains.push_back(placed.part);
  EXPECT_EQ(chains, (std::vector<uint32_t>{2, 2, 2, box, scene.hierarchy().placed[lone].part}));
}

/// A surface whose points are all held, each by leaves 0 and 1.
Baked held(const std::vector<Mesh>& meshes, float reach = 0) {
  Baker baker(Lattice{{0, 0, 0}, step}, {}, {});
  for (const Mesh& mesh : meshes) {
    const Surface surface = awkward::surface_of(mesh);
    baker.add(surface, std::vector<LeafSpan>(surface.points.size(), LeafSpan{0, 1, reach}));
  }
  return baker.finish(0);
}

/// Edges, and how many triangles have them.
std::map<std::array<uint32_t, 2>, int> edges_of(const Surface& surface) {
  std::map<std::array<uint32_t, 2>, int> edges;
  for (const Triangle& triangle : surface.triangles) {
    for (size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(triangle.vertices[k], triangle.vertices[(k + 1) % 3]);
      ++edges[{low, high}];
    }
  }
  return edges;
}

TEST(Stitch, points_on_edges_divide_them_on_both_sides) {
  // The lower edge of the upper rectangle has two points where the lower rectangle has a single edge.
  Mesh lower{.name = "", .positions = {{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {0, 1, 0}}, .triangles = {}};
  lower.triangles = {{{0, 1, 2}, 0}, {{0, 2, 3}, 0}};
  Mesh upper{.name = "",
             .positions = {{0, 1, 0}, {1, 1, 0}, {2, 1 + 8 * step, 0}, {3, 1, 0}, {3, 2, 0}, {0, 2, 0}},
             .triangles = {}};
  upper.triangles = {{{0, 1, 5}, 0}, {{1, 2, 5}, 0}, {{2, 4, 5}, 0}, {{2, 3, 4}, 0}};
  Baked baked = held({lower, upper});
  EXPECT_NEAR(stitch(baked), 8, 0.01) << "one of the points lies 8 steps off";
  EXPECT_EQ(baked.surface.points.size(), 8u);
  EXPECT_EQ(baked.surface.triangles.size(), 8u);
  size_t open = 0;
  for (const auto& [edge, count] : edges_of(baked.surface)) open += count == 1;
  EXPECT_EQ(open, 6u) << "only the outline of both is open";
  for (const Triangle& triangle : baked.surface.triangles) {
    const auto at = [&](size_t k) { return glm::dvec3(baked.surface.points[triangle.vertices[k]]); };
    EXPECT_GT(glm::cross(at(1) - at(0), at(2) - at(0)).z, 0);
  }
}

TEST(Stitch, near_points_become_one_unless_a_triangle_would_vanish) {
  Baked apart = held({awkward::box({0, 0, 0}, {1, 1, 1}), awkward::box({1 + 5 * step, 0, 0}, {2, 1, 1})});
  EXPECT_NEAR(stitch(apart), 5, 0.01);
  EXPECT_EQ(apart.surface.points.size(), 12u);
  EXPECT_EQ(apart.surface.triangles.size(), 24u);
  // A box thinner than the tolerance stays one.
  Baked thin = held({awkward::box({0, 0, 0}, {1, 1, 4 * step})});
  EXPECT_EQ(stitch(thin), 0);
  EXPECT_EQ(thin.surface.points.size(), 8u);
  EXPECT_EQ(thin.surface.triangles.size(), 12u);
}

size_t still_locked(const Baked& baked, double distance) {
  std::vector<uint8_t> locked(baked.surface.points.size(), 1);
  free_small_contacts(baked, distance / step, locked);
  return static_cast<size_t>(std::count(locked.begin(), locked.end(), 1));
}

TEST(SmallContacts, are_freed_once_a_level_is_off_by_half_their_size) {
  const Baked box = held({awkward::box({0, 0, 0}, {1, 1, 1})}, static_cast<float>(std::sqrt(2) / step));
  EXPECT_EQ(still_locked(box, 0.5), 8u);
  EXPECT_EQ(still_locked(box, 0.9), 0u) << "the box is no longer than 1.8";
  const Baked of_a_long_contact = held({awkward::box({0, 0, 0}, {1, 1, 1})}, 10 / step);
  EXPECT_EQ(still_locked(of_a_long_contact, 0.9), 8u);
  EXPECT_EQ(still_locked(of_a_long_contact, 5.1), 0u);
  const Baked of_a_border =
      held({awkward::box({0, 0, 0}, {1, 1, 1})}, std::numeric_limits<float>::infinity());
  EXPECT_EQ(still_locked(of_a_border, 1e9), 8u);
}

TEST(SmallContacts, of_a_long_seam_are_none) {
  std::vector<Mesh> tiles;
  for (int i = 0; i < 20; ++i) tiles.push_back(awkward::box({i, 0, 0}, {i + 1, 1, 1}));
  EXPECT_EQ(still_locked(held(tiles), 1), 84u) << "a row of tiles is as long as all of them";
  EXPECT_EQ(still_locked(held(tiles), 11), 0u);
}

}  // namespace
}  // namespace triptych
