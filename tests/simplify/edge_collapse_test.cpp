#include "simplify/edge_collapse.hpp"

#include "base/disjoint_sets.hpp"
#include "tests/support/awkward_meshes.hpp"
#include "tests/support/distance_judge.hpp"
#include "tests/support/hard_surfaces.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <map>
#include <set>

namespace triptych {
namespace {

size_t component_count(const Surface& surface) {
  DisjointSets connected(surface.points.size());
  for (const Triangle& triangle : surface.triangles) {
    for (const uint32_t corner : triangle.vertices) connected.join(corner, triangle.vertices[0]);
  }
  std::set<uint32_t> roots;
  for (uint32_t i = 0; i < surface.points.size(); ++i) roots.insert(connected.root(i));
  return roots.size();
}

TEST(EdgeCollapse, has_a_bound_that_no_point_of_any_colour_breaks) {
  for (const auto& [name, surface] : hard::surfaces()) {
    EdgeCollapse collapse(surface, {});
    for (size_t goal = surface.triangles.size() * 2 / 3; goal > 8; goal = goal * 2 / 3) {
      collapse.reduce_to(goal, 1e300);
      const Surface result = collapse.piece().surface;
      EXPECT_LE(judge::distance(surface, result), collapse.bound() + 1e-6)
          << name << " at " << result.triangles.size();
      if (result.triangles.size() > goal) break;
    }
  }
}

TEST(EdgeCollapse, has_an_error_for_each_triangle_that_none_of_its_points_breaks) {
  for (const auto& [name, surface] : hard::surfaces()) {
    EdgeCollapse collapse(surface, {});
    collapse.reduce_to(surface.triangles.size() / 5, 1e300);
    const Surface result = collapse.piece().surface;
    const std::vector<double> errors = collapse.errors();
    ASSERT_EQ(errors.size(), result.triangles.size()) << name;
    for (size_t i = 0; i < errors.size(); ++i) {
      EXPECT_LE(errors[i], collapse.bound()) << name;
      const Triangle& triangle = result.triangles[i];
      judge::Corners corners;
      for (size_t k = 0; k < 3; ++k) corners[k] = glm::dvec3(result.points[triangle.vertices[k]]);
      EXPECT_LE(judge::one_sided({corners}, judge::triangles_of(surface, triangle.material), 40),
                errors[i] + 1e-6)
          << name << ", triangle " << i;
    }
  }
}

TEST(EdgeCollapse, comes_close_to_its_bound_where_the_surface_is_smooth) {
  const Surface surface = awkward::surface_of(awkward::sphere(16, 8));
  EdgeCollapse collapse(surface, {});
  for (const size_t goal : {400u, 200u, 100u, 50u}) {
    collapse.reduce_to(goal, 1e300);
    const double distance = judge::distance(surface, collapse.piece().surface);
    EXPECT_LE(collapse.bound(), 3.5 * distance);
    EXPECT_LE(distance, 8 * 1024 * 12.0 / static_cast<double>(goal));  // a good mesh has about radius · 6 / n
  }
}

TEST(EdgeCollapse, makes_a_flat_plate_a_few_triangles_at_no_cost) {
  const Surface surface = awkward::surface_of(awkward::grid(30, 8));
  EdgeCollapse collapse(surface, {});
  collapse.reduce_to(2, 1e-3);
  EXPECT_LE(collapse.triangle_count(), 2u);
  EXPECT_LE(collapse.bound(), 1e-3);
}

TEST(EdgeCollapse, keeps_the_outline_of_colours_on_a_flat_plate) {
  const Surface surface = hard::checkers(16, 4);
  EdgeCollapse collapse(surface, {});
  collapse.reduce_to(0, 1e-3);
  // Four by four fields: two triangles each suffice.
  EXPECT_LE(collapse.triangle_count(), 32u);
  EXPECT_LE(judge::distance(surface, collapse.piece().surface), 1e-3);
}

TEST(EdgeCollapse, keeps_both_sides_of_a_sheet_and_simplifies_them_together) {
  const Surface surface = hard::two_sided(awkward::grid(16, 4));
  EdgeCollapse collapse(surface, {});
  collapse.reduce_to(0, 1e-3);
  EXPECT_LE(collapse.triangle_count(), 4u);
  EXPECT_LE(judge::distance(surface, collapse.piece().surface), 1e-3);
}

TEST(EdgeCollapse, loses_no_component_however_far_it_goes) {
  for (const auto& [name, surface] : hard::surfaces()) {
    EdgeCollapse collapse(surface, {});
    collapse.reduce_to(0, 1e300);
    EXPECT_GE(component_count(collapse.piece().surface), component_count(surface)) << name;
    EXPECT_LE(judge::distance(surface, collapse.piece().surface), collapse.bound() + 1e-6) << name;
  }
}

TEST(EdgeCollapse, has_bounds_that_never_shrink_and_stops_at_the_largest) {
  const Surface surface = awkward::surface_of(awkward::grid(24, 4, 0.3));
  EdgeCollapse collapse(surface, {});
  double before = 0;
  for (double largest = 1; largest < 4096; largest *= 2) {
    collapse.reduce_to(0, largest);
    EXPECT_GE(collapse.bound(), before);
    EXPECT_LE(collapse.bound(), largest);
    before = collapse.bound();
  }
  EXPECT_LT(collapse.triangle_count(), 40u);
}

TEST(EdgeCollapse, leaves_locked_points_in_their_places) {
  const Surface surface = awkward::surface_of(awkward::grid(16, 2, 0.2));
  std::vector<uint8_t> locked;
  for (const glm::ivec3& point : surface.points) locked.push_back(point.x == 0 || point.y % 512 == 0);
  EdgeCollapse collapse(surface, locked);
  collapse.reduce_to(0, 1e300);
  const Piece piece = collapse.piece();
  const std::set<uint32_t> kept(piece.sources.begin(), piece.sources.end());
  for (uint32_t i = 0; i < locked.size(); ++i) EXPECT_TRUE(!locked[i] || kept.contains(i));
  EXPECT_LT(piece.surface.triangles.size(), surface.triangles.size() / 2);
}

TEST(EdgeCollapse, makes_no_triangle_without_area_and_no_new_points) {
  for (const auto& [name, surface] : hard::surfaces()) {
    EdgeCollapse collapse(surface, {});
    collapse.reduce_to(surface.triangles.size() / 8, 1e300);
    const Piece piece = collapse.piece();
    const auto& points = piece.surface.points;
    for (const Triangle& t : piece.surface.triangles) {
      EXPECT_FALSE(degenerate(points[t.vertices[0]], points[t.vertices[1]], points[t.vertices[2]])) << name;
    }
    for (size_t i = 0; i < points.size(); ++i) EXPECT_EQ(points[i], surface.points[piece.sources[i]]) << name;
  }
}

TEST(EdgeCollapse, gives_the_same_every_time) {
  for (const auto& [name, surface] : hard::surfaces()) {
    EdgeCollapse first(surface, {}), second(surface, {});
    first.reduce_to(surface.triangles.size() / 4, 1e300);
    second.reduce_to(surface.triangles.size() / 2, 1e300);  // stops on the way change nothing
    second.reduce_to(surface.triangles.size() / 4, 1e300);
    EXPECT_EQ(first.piece().surface.triangles, second.piece().surface.triangles) << name;
    EXPECT_EQ(first.bound(), second.bound()) << name;
  }
}

TEST(EdgeCollapse, counts_the_triangles_beyond_the_second_at_an_edge) {
  EXPECT_EQ(EdgeCollapse(awkward::surface_of(awkward::grid(8)), {}).crowded_triangles(), 0u);
  const Surface book = awkward::surface_of(awkward::book(5, 8));  // eight edges of five triangles
  EXPECT_EQ(EdgeCollapse(book, {}).crowded_triangles(), 24u);
  const std::vector<uint8_t> locked(book.points.size(), 1);
  EXPECT_EQ(EdgeCollapse(book, locked).crowded_triangles(), 24u);
}

TEST(EdgeCollapse, takes_large_coordinates_and_hubs) {
  // A disc of a thousand triangles around one point, as far out as lattices go.
  Surface disc;
  disc.points.push_back({0, 0, 1 << 28});
  for (int i = 0; i < 1000; ++i) {
    const double angle = i * 0.006283185307;
    disc.points.push_back(
        glm::ivec3(glm::round(glm::dvec3{std::cos(angle), std::sin(angle), 0} * double(1 << 29))));
  }
  for (uint32_t i = 0; i < 1000; ++i) disc.triangles.push_back({{0, 1 + i, 1 + (i + 1) % 1000}, 0});
  EdgeCollapse collapse(disc, {});
  collapse.reduce_to(20, 1e300);
  EXPECT_LE(collapse.triangle_count(), 20u);
  EXPECT_LE(judge::distance(disc, collapse.piece().surface), collapse.bound());
  EXPECT_LE(collapse.bound(), (1 << 29) * 0.2);
}

}  // namespace
}  // namespace triptych
