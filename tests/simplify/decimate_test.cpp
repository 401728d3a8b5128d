#include "simplify/decimate.hpp"

#include "simplify/distance.hpp"
#include "tests/support/awkward_meshes.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

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

}  // namespace
}  // namespace triptych
