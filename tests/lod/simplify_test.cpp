#include "lod/simplify.hpp"

#include "lod/decimate.hpp"
#include "lod/vertex_clustering.hpp"
#include "tests/support/awkward_meshes.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <set>

namespace triptych {
namespace {

size_t pieces_of(const Mesh& mesh) { return mesh.triangles.size(); }

/// Many small boxes in rows.
Mesh shelf(int count) {
  Mesh mesh{"shelf", {}, {}};
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 lo{i % 10, i / 10, 0};
    awkward::append(mesh, awkward::box(lo, lo + 0.5));
  }
  return mesh;
}

TEST(VertexClustering, keeps_every_disjoint_piece_within_its_bound) {
  for (const Mesh& mesh : {awkward::soup(300), shelf(50), awkward::sphere(15), awkward::book(4)}) {
    const Surface surface = awkward::surface_of(mesh);
    for (const double cell : {100.0, 700.0, 3000.0, 50000.0}) {
      const Clustered clustered = cluster_vertices(surface, {}, cell);
      ASSERT_FALSE(clustered.piece.surface.triangles.empty());
      EXPECT_LE(clustered.bound, 2 * std::sqrt(3.0) * cell);
      // The same, found by measuring: within what the construction promises, but for the measure's own slack.
      EXPECT_LE(distance_bound(surface, clustered.piece.surface, Colors::ignore), clustered.bound * 1.3 + 1)
          << mesh.name << " cell " << cell;
    }
  }
}

TEST(VertexClustering, makes_no_triangle_without_area_and_no_new_points) {
  const Surface surface = awkward::surface_of(awkward::soup(300));
  const Clustered clustered = cluster_vertices(surface, {}, 800);
  const Surface& result = clustered.piece.surface;
  for (const Triangle& t : result.triangles) {
    EXPECT_FALSE(
        degenerate(result.points[t.vertices[0]], result.points[t.vertices[1]], result.points[t.vertices[2]]));
  }
  for (size_t i = 0; i < result.points.size(); ++i) {
    EXPECT_EQ(result.points[i], surface.points[clustered.piece.sources[i]]);
  }
}

TEST(VertexClustering, merges_disjoint_pieces_to_any_number_of_triangles) {
  const Surface surface = awkward::surface_of(awkward::soup(2000));
  for (const size_t target : {500u, 50u, 1u}) {
    EXPECT_LE(cluster_to(surface, {}, target).piece.surface.triangles.size(), target);
  }
}

TEST(VertexClustering, leaves_locked_points_where_they_are) {
  const Surface surface = awkward::surface_of(awkward::grid(20));
  std::vector<uint8_t> locked(surface.points.size(), 0);
  for (size_t i = 0; i < locked.size(); ++i) locked[i] = surface.points[i].x == 0;
  const Clustered clustered = cluster_vertices(surface, locked, 400);
  const std::set<uint32_t> kept(clustered.piece.sources.begin(), clustered.piece.sources.end());
  for (uint32_t i = 0; i < locked.size(); ++i) {
    EXPECT_TRUE(!locked[i] || kept.contains(i));
  }
  EXPECT_LT(clustered.piece.surface.triangles.size(), surface.triangles.size() / 2);
}

TEST(Decimation, keeps_the_outline_of_a_flat_sheet) {
  const Surface surface = awkward::surface_of(awkward::grid(32, 8));
  Decimation decimation(surface, {});
  const Piece piece = decimation.reduce_to(16);
  EXPECT_LE(piece.surface.triangles.size(), 16u);
  EXPECT_LE(distance_bound(surface, piece.surface, Colors::ignore), 0.3);
}

TEST(Decimation, keeps_the_outline_of_colours) {
  Mesh mesh = awkward::grid(16, 16);
  for (Triangle& triangle : mesh.triangles) {
    const glm::dvec3 p = mesh.positions[triangle.vertices[0]];
    triangle.material = p.x >= 4 && p.x < 12 && p.y >= 4 && p.y < 12;
  }
  const Surface surface = awkward::surface_of(mesh);
  Decimation decimation(surface, {});
  const Piece piece = decimation.reduce_to(40);
  EXPECT_LE(piece.surface.triangles.size(), 60u);
  EXPECT_LE(distance_bound(surface, piece.surface, Colors::keep), 0.3);
}

TEST(Decimation, represents_triangles_that_half_edges_cannot_join) {
  const Surface surface = awkward::surface_of(awkward::book(5));
  Decimation decimation(surface, {});
  EXPECT_GT(decimation.detached_triangles(), 0u);
  const Piece all = decimation.reduce_to(surface.triangles.size());
  EXPECT_EQ(all.surface.triangles.size(), surface.triangles.size());
  EXPECT_EQ(distance_bound(surface, all.surface, Colors::ignore), 0);
}

TEST(Simplify, halves_until_the_target_with_bounds_that_hold_and_grow) {
  for (const Mesh& mesh :
       {awkward::sphere(14), awkward::grid(16, 2, 0.2), awkward::soup(300), shelf(40), awkward::book(6, 6)}) {
    const Surface surface = awkward::surface_of(mesh);
    SimplifyLimits limits;
    limits.triangles = 40;
    const Chain chain = simplify(surface, {}, limits);
    ASSERT_FALSE(chain.levels.empty()) << mesh.name;
    EXPECT_FALSE(chain.stuck) << mesh.name;
    size_t before = surface.triangles.size();
    double bound = 0;
    for (const Level& level : chain.levels) {
      EXPECT_LE(level.piece.surface.triangles.size(), before * 3 / 4);
      EXPECT_GE(level.bound, bound);
      // Measured against the input in one go, which the chain of bounds must cover.
      const double direct = distance_bound(surface, level.piece.surface, Colors::ignore);
      EXPECT_LE(direct, level.bound * 1.3 + 1) << mesh.name;
      before = level.piece.surface.triangles.size();
      bound = level.bound;
    }
    EXPECT_LE(before, 40u) << mesh.name << " of " << pieces_of(mesh);
  }
}

TEST(Simplify, keeps_locked_borders_at_every_level) {
  const Surface surface = awkward::surface_of(awkward::grid(24, 1, 0.1));
  std::vector<uint8_t> locked(surface.points.size(), 0);
  for (size_t i = 0; i < locked.size(); ++i) locked[i] = surface.points[i].x == 0;
  SimplifyLimits limits;
  const Chain chain = simplify(surface, locked, limits);
  ASSERT_FALSE(chain.levels.empty());
  for (const Level& level : chain.levels) {
    const std::set<uint32_t> kept(level.piece.sources.begin(), level.piece.sources.end());
    for (uint32_t i = 0; i < locked.size(); ++i) {
      EXPECT_TRUE(!locked[i] || kept.contains(i));
    }
  }
}

TEST(Simplify, a_smooth_sphere_is_cheap_to_halve) {
  const Surface surface = awkward::surface_of(awkward::sphere(40));
  SimplifyLimits limits;
  limits.triangles = surface.triangles.size() / 2;
  const Chain chain = simplify(surface, {}, limits);
  ASSERT_EQ(chain.levels.size(), 1u);
  EXPECT_LE(chain.levels[0].bound, 1024 * 0.02);  // 2 % of the radius
}

TEST(Simplify, leaves_a_single_triangle_alone) {
  const Surface surface = awkward::surface_of({"one", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{{0, 1, 2}, 0}}});
  EXPECT_TRUE(simplify(surface, {}, {}).levels.empty());
}

}  // namespace
}  // namespace triptych
