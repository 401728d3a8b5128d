#include "simplify/vertex_clustering.hpp"

#include "tests/support/distance_judge.hpp"
#include "tests/support/hard_surfaces.hpp"

#include <gtest/gtest.h>
#include <set>

namespace triptych {
namespace {

TEST(VertexClustering, keeps_every_disjoint_piece_within_its_bound) {
  for (const auto& [name, surface] : hard::surfaces()) {
    for (const double cell : {100.0, 700.0, 3000.0, 50000.0}) {
      const Clustered kept = cluster_vertices(surface, {}, cell, Colors::keep),
                      merged = cluster_vertices(surface, {}, cell, Colors::ignore);
      ASSERT_FALSE(merged.piece.surface.triangles.empty());
      EXPECT_LE(merged.piece.surface.triangles.size(), kept.piece.surface.triangles.size());
      EXPECT_LE(kept.bound, 2 * std::sqrt(3.0) * cell);
      EXPECT_LE(judge::distance(surface, kept.piece.surface, 1000), kept.bound + 1e-6)
          << name << " cell " << cell;
      EXPECT_LE(judge::distance_without_colors(surface, merged.piece.surface, 1000), merged.bound + 1e-6)
          << name << " cell " << cell;
    }
  }
}

TEST(VertexClustering, makes_no_triangle_without_area_and_no_new_points) {
  const Surface surface = awkward::surface_of(awkward::soup(300));
  const Clustered clustered = cluster_vertices(surface, {}, 800, Colors::keep);
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
    EXPECT_LE(cluster_to(surface, {}, target, Colors::keep).piece.surface.triangles.size(), target);
  }
}

TEST(VertexClustering, says_whether_so_many_are_enough_without_making_them) {
  const Surface surface = awkward::surface_of(awkward::soup(300));
  for (const double cell : {100.0, 800.0, 6000.0}) {
    const size_t count = cluster_vertices(surface, {}, cell, Colors::keep).piece.surface.triangles.size();
    EXPECT_TRUE(clusters_within(surface, {}, cell, count, Colors::keep));
    EXPECT_FALSE(clusters_within(surface, {}, cell, count - 1, Colors::keep));
  }
}

TEST(VertexClustering, leaves_locked_points_where_they_are) {
  const Surface surface = awkward::surface_of(awkward::grid(20));
  std::vector<uint8_t> locked(surface.points.size(), 0);
  for (size_t i = 0; i < locked.size(); ++i) locked[i] = surface.points[i].x == 0;
  const Clustered clustered = cluster_vertices(surface, locked, 400, Colors::keep);
  const std::set<uint32_t> kept(clustered.piece.sources.begin(), clustered.piece.sources.end());
  for (uint32_t i = 0; i < locked.size(); ++i) {
    EXPECT_TRUE(!locked[i] || kept.contains(i));
  }
  EXPECT_LT(clustered.piece.surface.triangles.size(), surface.triangles.size() / 2);
}

}  // namespace
}  // namespace triptych
