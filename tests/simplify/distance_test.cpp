#include "simplify/distance.hpp"

#include "simplify/edge_collapse.hpp"
#include "simplify/triangle_tree.hpp"
#include "tests/support/awkward_meshes.hpp"
#include "tests/support/distance_judge.hpp"
#include "tests/support/hard_surfaces.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <random>

namespace triptych {
namespace {

Corners corners_of(const Surface& surface, const Triangle& triangle) {
  return {glm::dvec3(surface.points[triangle.vertices[0]]), glm::dvec3(surface.points[triangle.vertices[1]]),
          glm::dvec3(surface.points[triangle.vertices[2]])};
}

/// Plain search from many points of each triangle: never more than the truth.
double sampled_one_sided(const Surface& from, const Surface& to, int steps) {
  double largest = 0;
  for (const Triangle& triangle : from.triangles) {
    const Corners corners = corners_of(from, triangle);
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; i + j <= steps; ++j) {
        const double u = double(i) / steps, v = double(j) / steps;
        const glm::dvec3 point = corners[0] + (corners[1] - corners[0]) * u + (corners[2] - corners[0]) * v;
        double nearest = 1e300;
        for (const Triangle& other : to.triangles) {
          nearest = std::min(nearest, glm::distance(point, closest_point(point, corners_of(to, other))));
        }
        largest = std::max(largest, nearest);
      }
    }
  }
  return largest;
}

double sampled(const Surface& a, const Surface& b, int steps = 6) {
  return std::max(sampled_one_sided(a, b, steps), sampled_one_sided(b, a, steps));
}

void expect_tight(const Surface& a, const Surface& b, double factor) {
  const double truth = sampled(a, b), bound = distance_bound(a, b, Colors::ignore);
  EXPECT_GE(bound, truth);
  EXPECT_LE(bound, truth * factor + 0.3);
  EXPECT_EQ(bound > 0, distance_bound(b, a, Colors::ignore) > 0);
}

TEST(DistanceBound, of_a_surface_to_itself_is_zero) {
  const Surface surface = awkward::surface_of(awkward::soup(200));
  EXPECT_EQ(distance_bound(surface, surface, Colors::keep), 0);
}

TEST(DistanceBound, of_spheres_holds_and_is_tight) {
  expect_tight(awkward::surface_of(awkward::sphere(12)), awkward::surface_of(awkward::sphere(7)), 1.4);
  expect_tight(awkward::surface_of(awkward::sphere(8)),
               awkward::surface_of(awkward::sphere(8, 1, {0.3, 0.1, 0})), 1.4);
}

TEST(DistanceBound, of_planes_holds_and_is_tight) {
  const Surface fine = awkward::surface_of(awkward::grid(16)), coarse = awkward::surface_of(awkward::grid(1));
  EXPECT_LE(distance_bound(fine, coarse, Colors::keep),
            0.3);  // the same square: a quarter of a step and rounding
  expect_tight(awkward::surface_of(awkward::grid(12, 1, 0.1)), coarse, 1.4);
  Mesh lifted = awkward::grid(3);
  for (glm::dvec3& p : lifted.positions) p.z = 0.5;
  expect_tight(awkward::surface_of(lifted), coarse, 1.4);
}

TEST(DistanceBound, sees_a_piece_that_only_one_side_has) {
  Mesh mesh = awkward::grid(6);
  const Surface without = awkward::surface_of(mesh);
  awkward::append(mesh, awkward::box({0.4, 0.4, 3}, {0.41, 0.41, 3.01}));
  const Surface with = awkward::surface_of(mesh);
  EXPECT_GE(distance_bound(with, without, Colors::ignore), 3 * 1024.0);
  EXPECT_LE(distance_bound(with, without, Colors::ignore), 3.9 * 1024.0);
  EXPECT_EQ(distance_bound(with, without, Colors::ignore), distance_bound(without, with, Colors::ignore));
}

TEST(DistanceBound, sees_a_hole_between_corners_that_all_are_on_the_other_surface) {
  // A square with its middle missing against the whole square: no corner is off, the middle of a triangle is.
  const Surface whole = awkward::surface_of(awkward::grid(1, 12));
  Mesh ring = awkward::grid(12, 12);
  std::erase_if(ring.triangles, [&](const Triangle& triangle) {
    const glm::dvec3 p = ring.positions[triangle.vertices[0]];
    return p.x > 2.5 && p.x < 8.5 && p.y > 2.5 && p.y < 8.5;
  });
  const double bound = distance_bound(whole, awkward::surface_of(ring), Colors::ignore);
  EXPECT_GE(bound, 3 * 1024.0);
  EXPECT_LE(bound, 3 * 1024.0 * 1.3);
}

TEST(DistanceBound, of_soups_holds) {
  std::mt19937 random(11);
  for (uint32_t seed = 1; seed < 6; ++seed) {
    const Surface a = awkward::surface_of(awkward::soup(60, seed)),
                  b = awkward::surface_of(awkward::soup(60, seed + 100));
    expect_tight(a, b, 1.4);
  }
}

TEST(DistanceBound, of_a_grating_holds_and_is_tight) {
  // Bars that are long and thin: no triangle of one lies over a single one of the other.
  Mesh bars;
  for (int i = 0; i < 12; ++i) awkward::append(bars, awkward::box({0.4 * i, 0, 0}, {0.4 * i + 0.1, 50, 0.2}));
  const Surface surface = awkward::surface_of(bars);
  EdgeCollapse collapse(surface, {});
  for (const size_t goal : {96u, 72u, 48u}) {
    collapse.reduce_to(goal, 1e300);
    const Surface coarse = collapse.piece().surface;
    ASSERT_LE(coarse.triangles.size(), goal);
    const double truth = judge::distance(surface, coarse, 20000);
    for (const Colors colors : {Colors::keep, Colors::ignore}) {
      const double bound = distance_bound(surface, coarse, colors);
      EXPECT_GE(bound, truth);
      EXPECT_LE(bound, truth * 1.4);
    }
  }
}

TEST(DistanceBound, holds_where_triangles_are_known_to_be_near) {
  for (const auto& [name, surface] : hard::surfaces()) {
    EdgeCollapse collapse(surface, {});
    for (const size_t share : {3u, 9u}) {
      collapse.reduce_to(surface.triangles.size() / share, 1e300);
      const Surface coarse = collapse.piece().surface;
      const std::vector<double> errors = collapse.errors();
      const double truth = judge::distance(surface, coarse, 25000);
      const double bound = distance_bound(surface, coarse, Colors::keep, {1.25, collapse.bound(), errors});
      EXPECT_GE(bound + 1e-6, truth) << name;
      EXPECT_LE(bound, std::min(collapse.bound(), 1.5 * truth + 0.3)) << name;
    }
  }
}

TEST(DistanceBound, counts_a_colour_that_moved) {
  Mesh striped = awkward::grid(10, 10);
  for (size_t i = 0; i < striped.triangles.size(); ++i)
    striped.triangles[i].material = i < 100 ? 0 : 1;  // y < 5
  Mesh shifted = striped;
  for (size_t i = 0; i < shifted.triangles.size(); ++i)
    shifted.triangles[i].material = i < 140 ? 0 : 1;  // y < 7
  const Surface a = awkward::surface_of(striped), b = awkward::surface_of(shifted);
  EXPECT_LE(distance_bound(a, b, Colors::ignore), 0.3);
  EXPECT_GE(distance_bound(a, b, Colors::keep), 2 * 1024.0);
  EXPECT_LE(distance_bound(a, b, Colors::keep), 2 * 1024.0 * 1.3);
}

TEST(DistanceBound, counts_a_lost_spot_with_its_size) {
  Mesh spotted = awkward::grid(100, 100);
  spotted.triangles[1000].material = spotted.triangles[1001].material = 1;
  Mesh plain = awkward::grid(100, 100);
  const double bound = distance_bound(awkward::surface_of(spotted), awkward::surface_of(plain), Colors::keep);
  EXPECT_GE(bound, 0.5 * 1024);
  EXPECT_LE(bound, 1.5 * 1024);
}

TEST(TriangleTree, finds_what_a_plain_search_finds) {
  const Surface surface = awkward::surface_of(awkward::soup(500));
  std::vector<Corners> triangles;
  for (const Triangle& triangle : surface.triangles) triangles.push_back(corners_of(surface, triangle));
  const TriangleTree tree(triangles);
  std::mt19937 random(5);
  for (int i = 0; i < 300; ++i) {
    const glm::dvec3 point{random() % 12000, random() % 12000, random() % 12000};
    double nearest = 1e300;
    for (const Corners& triangle : triangles) {
      nearest = std::min(nearest, glm::distance(point, closest_point(point, triangle)));
    }
    EXPECT_NEAR(std::sqrt(tree.nearest(point).squared_distance), nearest, 1e-6);
  }
}

}  // namespace
}  // namespace triptych
