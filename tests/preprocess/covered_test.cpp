// What lies right beneath other surfaces: what is found, and what levels of detail make of it.
#include "preprocess/contacts/find_contacts.hpp"
#include "preprocess/covered/closed_surface.hpp"
#include "preprocess/covered/leave_out.hpp"
#include "preprocess/covered/make_room.hpp"
#include "preprocess/covered/surroundings.hpp"
#include "tests/preprocess/parts_scene.hpp"

#include <gtest/gtest.h>
#include <map>

namespace triptych {
namespace {

Mesh inside_out(Mesh mesh) {
  for (Triangle& triangle : mesh.triangles) std::swap(triangle.vertices[0], triangle.vertices[1]);
  return mesh;
}

struct CoverScene : test::PartsScene {
  uint32_t add_body(const Mesh& mesh) {
    const uint32_t placed = add(mesh);
    PartInfo& info = parts.parts[hierarchy().placed[placed].part];
    info.outside = outside_of(awkward::surface_of(mesh));
    return placed;
  }
  CoveredReport make() { return make_room(parts, file, 1 << 20, PlacedCache(nullptr, parts, file)); }
  const PartInfo& part(uint32_t placed) const {
    return parts.parts[parts.hierarchies[0].placed[placed].part];
  }
  size_t covered(uint32_t placed) const { return part(placed).covered.size(); }
  const std::vector<ErrorGap>& gaps(uint32_t placed) const { return part(placed).gaps; }
};

TEST(Covered, closed_surfaces_look_out_on_one_side) {
  EXPECT_EQ(outside_of(awkward::surface_of(awkward::sphere(12))), Outside::front);
  EXPECT_EQ(outside_of(awkward::surface_of(inside_out(awkward::sphere(12)))), Outside::back);
  EXPECT_EQ(outside_of(awkward::surface_of(awkward::grid(4))), Outside::none);
  Mesh open = awkward::box({0, 0, 0}, {1, 1, 1});
  open.triangles.pop_back();
  EXPECT_EQ(outside_of(awkward::surface_of(open)), Outside::none);
}

TEST(Covered, a_ball_in_a_shell_is_covered_and_both_keep_their_distance) {
  for (const bool turned : {false, true}) {
    CoverScene scene;
    const auto made = [&](double radius) {
      const Mesh ball = awkward::sphere(24, radius);
      return turned ? inside_out(ball) : ball;
    };
    const uint32_t shell = scene.add_body(made(8)), ball = scene.add_body(made(7.9));
    const CoveredReport report = scene.make();
    EXPECT_EQ(scene.covered(shell), 0u);
    EXPECT_EQ(scene.covered(ball), scene.parts.parts[ball].triangles) << "all of it";
    EXPECT_EQ(report.triangles, scene.covered(ball));
    EXPECT_EQ(report.parts, 2u);
    for (const uint32_t placed : {shell, ball}) {
      ASSERT_EQ(scene.gaps(placed).size(), 1u);
      EXPECT_LT(scene.gaps(placed)[0].low, 0.05);
      EXPECT_GT(scene.gaps(placed)[0].low, 0.02);
      EXPECT_GE(scene.gaps(placed)[0].high, 0.1);
      EXPECT_LT(scene.gaps(placed)[0].high, 0.2);
    }
  }
}

TEST(Covered, what_shows_somewhere_is_not) {
  CoverScene scene;
  // A layer on half of a block; a ball that looks out of its shell; an open sheet in a box.
  const uint32_t block = scene.add_body(awkward::box({0, 0, 0}, {8, 8, 2}));
  scene.add_body(awkward::box({0, 0, 2}, {4, 8, 2.125}));
  scene.add_body(awkward::sphere(16, 1, {20, 0, 0}));
  const uint32_t ball = scene.add_body(awkward::sphere(16, 1, {20.25, 0, 0}));
  const uint32_t sheet = scene.add_body(awkward::grid(4));
  scene.make();
  EXPECT_EQ(scene.covered(block), 0u);
  EXPECT_EQ(scene.covered(ball), 0u);
  EXPECT_EQ(scene.covered(sheet), 0u);
}

TEST(Covered, layers_of_a_wall_are_covered_where_they_touch) {
  CoverScene scene;
  scene.add_body(awkward::box({0, 0, 0}, {16, 0.0625, 4}));
  const uint32_t middle = scene.add_body(awkward::box({0, 0.0625, 0}, {16, 0.5, 4}));
  scene.add_body(awkward::box({0, 0.5, 0}, {16, 0.5625, 4}));
  scene.make();
  EXPECT_EQ(scene.covered(middle), 4u) << "its two large faces";
}

TEST(Covered, plates_thinner_than_what_counts_as_touching_do_not_cover_each_other) {
  CoverScene scene;
  constexpr double thin = 4 * test::step;  // of 16 steps that touch
  uint32_t outermost = 0;
  for (int i = 0; i < 3; ++i)
    outermost = scene.add_body(awkward::box({0, 0, i * thin}, {8, 8, (i + 1) * thin}));
  const uint32_t alone = scene.add_body(awkward::box({20, 0, 0}, {28, 8, thin}));
  scene.make();
  EXPECT_EQ(scene.covered(alone), 0u);
  EXPECT_EQ(scene.covered(outermost), 2u) << "the face that the next plate lies on";
}

TEST(Covered, each_face_has_a_distance_of_its_own) {
  CoverScene scene;
  scene.add_body(awkward::box({0, 0, 0}, {16, 0.0625, 16}));
  const uint32_t middle = scene.add_body(awkward::box({0, 0.0625, 0}, {16, 1, 16}));
  scene.add_body(awkward::box({0, 1, 0}, {16, 1.5, 16}));
  scene.make();
  std::map<uint32_t, int> faces;
  for (const CoveredTriangle& covered : scene.part(middle).covered) ++faces[covered.of_class];
  ASSERT_EQ(faces.size(), 2u) << "beneath 1/16 and beneath 1/2";
  const double near = distance_of_class(faces.begin()->first), far = distance_of_class(faces.rbegin()->first);
  EXPECT_NEAR(near * test::step, 0.0625 + contact_steps * test::step, 0.01);
  EXPECT_NEAR(far * test::step, 0.5 + contact_steps * test::step, 0.06);
  EXPECT_EQ(faces.begin()->second, 2);
  EXPECT_EQ(faces.rbegin()->second, 2);
  // Between the two, levels may have errors.
  ASSERT_EQ(scene.gaps(middle).size(), 1u) << "surfaces that touch keep apart by a share of the distance";
}

TEST(Surroundings, hide_from_the_sides_what_lies_deep_beneath_a_wide_cover_alone) {
  for (const double half : {2.0, 8.0}) {
    CoverScene scene;
    const uint32_t block = scene.add_body(awkward::box({-1, -1, -1}, {1, 1, 0}));
    const uint32_t cover = scene.add_body(awkward::box({-half, -half, 1}, {half, half, 1.5}));
    PartCache<PartRegions> cache(scene.parts, scene.file, 1 << 20);
    const auto box = [&](uint32_t placed) {
      return scene.parts.lattices[0].box(scene.hierarchy().boxes[placed]);
    };
    Surroundings surroundings(scene.parts, scene.hierarchy(), cache, block,
                              {{block, box(block)}, {cover, box(cover)}}, contact_steps * test::step);
    const glm::dvec3 from(0.25, 0.25, 0), up(0, 0, 1);
    constexpr uint32_t top = no_id;  // no region of the block: all of it counts
    const auto over = surroundings.over(top, from, up, 20);
    ASSERT_TRUE(over);
    EXPECT_EQ(over->placed, cover);
    EXPECT_NEAR(over->clearance, 1, 1e-9);
    EXPECT_FALSE(surroundings.over(top, from, up, 15)) << "further than a sixteenth";
    EXPECT_EQ(surroundings.hidden_from_sides(top, from, up, 20), half == 8);
  }
}

TEST(Covered, a_part_that_is_covered_in_one_placement_alone_is_not) {
  CoverScene scene;
  const uint32_t shell = scene.add_body(awkward::sphere(24, 8));
  const uint32_t ball = scene.add_body(awkward::sphere(24, 7.9));
  scene.place(scene.hierarchy().placed[ball].part, {40, 0, 0});
  scene.make();
  EXPECT_EQ(scene.covered(ball), 0u);
  EXPECT_TRUE(scene.gaps(shell).empty());
}

TEST(Covered, placements_among_the_same_others_are_looked_at_once_and_all_keep_their_distance) {
  CoverScene scene;
  const uint32_t shell = scene.add_body(awkward::sphere(12, 4)),
                 ball = scene.add_body(awkward::sphere(12, 3.9));
  for (int i = 1; i < 6; ++i) {
    for (const uint32_t placed : {shell, ball})
      scene.place(scene.hierarchy().placed[placed].part, {12.0 * i, 0, 0});
  }
  scene.make();
  EXPECT_EQ(scene.covered(ball), scene.parts.parts[ball].triangles);
  EXPECT_EQ(scene.gaps(shell).size(), 1u);
}

TEST(ErrorGaps, raise_errors_to_their_ends_and_join_where_they_overlap) {
  std::vector<ErrorGap> gaps;
  add_gap({1, 2}, gaps);
  add_gaps({{2, 4}, {0.5, 0.6}}, 2, gaps);
  join_gaps(gaps);
  ASSERT_EQ(gaps.size(), 2u);
  EXPECT_EQ(beyond_gaps(0.9, gaps), 0.9);
  EXPECT_EQ(beyond_gaps(1, gaps), 1);
  EXPECT_EQ(beyond_gaps(1.5, gaps), 2) << "joined 1 to 1.2 and 1 to 2";
  EXPECT_EQ(beyond_gaps(5, gaps), 8);
  EXPECT_EQ(beyond_gaps(8, gaps), 8);
  for (const double distance : {0.1, 1.0, 1.3, 77.0, 1e6}) {
    const double of_class = distance_of_class(class_of_distance(distance));
    EXPECT_GE(of_class, distance);
    EXPECT_LE(of_class, std::max(distance, 1.0) * 1.0906);
  }
}

TEST(LeaveOut, only_what_is_covered_by_less_goes) {
  const Surface body = awkward::surface_of(awkward::box({0, 0, 0}, {1, 1, 1}));
  Piece piece{body, {}};
  for (uint32_t i = 0; i < body.points.size(); ++i) piece.sources.push_back(i);
  const uint32_t of_class = class_of_distance(100);
  for (size_t i = 0; i < 4; ++i) {
    uint32_t& material = piece.surface.triangles[i].material;
    material = material_covered(material, of_class);
  }
  EXPECT_FALSE(without_covered(piece, 50));
  const auto left = without_covered(piece, 150);
  ASSERT_TRUE(left);
  EXPECT_EQ(left->surface.triangles.size(), 8u);
  for (uint32_t i = 0; i < left->sources.size(); ++i)
    EXPECT_EQ(left->surface.points[i], body.points[left->sources[i]]);
  for (Triangle& triangle : piece.surface.triangles) triangle.material = material_covered(0, of_class);
  EXPECT_FALSE(without_covered(piece, 150)) << "something is left of everything";
  EXPECT_EQ(speck(piece.surface).triangles.size(), 1u);
}

}  // namespace
}  // namespace triptych
