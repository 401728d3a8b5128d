#include "preprocess/weld.hpp"

#include "tests/support/awkward_meshes.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace triptych {
namespace {

const std::vector<uint32_t> palette_of_materials = {0, 1, 2};
const VertexTint white;
const MeshColors colors{palette_of_materials}, of_corners{palette_of_materials, &white};
const Lattice lattice{{0, 0, 0}, 0x1p-10};

TEST(Weld, a_soup_of_a_grid_becomes_the_grid) {
  const Mesh grid = awkward::grid(8);
  Mesh soup{"soup", {}, {}};
  for (const Triangle& triangle : grid.triangles) {
    const auto first = static_cast<uint32_t>(soup.positions.size());
    for (const uint32_t vertex : triangle.vertices) soup.positions.push_back(grid.positions[vertex]);
    soup.triangles.push_back({{first, first + 1, first + 2}, 0});
  }
  const Welded welded = weld(soup, Affine(1), lattice, colors);
  EXPECT_EQ(welded.surface.points.size(), grid.positions.size());
  EXPECT_EQ(welded.surface.triangles.size(), grid.triangles.size());
  EXPECT_EQ(welded.welded_vertices, soup.positions.size() - grid.positions.size());
  EXPECT_EQ(welded.dropped_triangles, 0u);
}

TEST(Weld, triangles_without_area_and_second_copies_are_dropped_and_counted) {
  const Mesh mesh{
      "m",
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {0, 0, 0}},
      {{{0, 1, 2}, 0}, {{1, 2, 0}, 0}, {{0, 1, 3}, 0}, {{0, 4, 2}, 0}, {{4, 1, 2}, 1}, {{0, 2, 1}, 0}}};
  const Welded welded = weld(mesh, Affine(1), lattice, colors);
  EXPECT_EQ(welded.dropped_triangles, 4u);
  ASSERT_EQ(welded.surface.triangles.size(), 2u);  // the triangle and its other side
  EXPECT_EQ(welded.surface.triangles[0].vertices, (std::array<uint32_t, 3>{0, 1, 2}));
  EXPECT_EQ(welded.surface.points.size(), 3u);  // the far end of the line went with it
}

TEST(Weld, a_mirroring_transform_keeps_the_outside_outside) {
  const Mesh mesh{"m", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{{0, 1, 2}, 0}}};
  Affine mirror(1);
  mirror[0].x = -1;
  const Surface surface = weld(mesh, mirror, lattice, colors).surface;
  const auto& [a, b, c] = surface.triangles.at(0).vertices;
  const glm::ivec3 u = surface.points[b] - surface.points[a], v = surface.points[c] - surface.points[a];
  EXPECT_GT(u.x * v.y - u.y * v.x, 0);
}

TEST(Weld, a_triangle_that_is_thinner_than_anything_but_a_step_stays) {
  const Mesh mesh{"m", {{0, 0, 0}, {1000, 0, 0}, {2000, 0x1p-10, 0}}, {{{0, 1, 2}, 0}}};
  EXPECT_EQ(weld(mesh, Affine(1), lattice, colors).surface.triangles.size(), 1u);
}

TEST(Weld, what_would_vanish_is_drawn_a_step_wide) {
  // On a lattice of whole units: a triangle, a box of three hundredths beside it, and a line that leaves it.
  const Lattice coarse{{0, 0, 0}, 1};
  Mesh mesh = awkward::box({7, 7, 7}, {7.03, 7.03, 7.03});
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  for (const glm::dvec3& point : {glm::dvec3(0, 0, 0), {4, 0, 0}, {0, 4, 0}, {-9, 0, 0}, {-5, 0.1, 0}})
    mesh.positions.push_back(point);
  mesh.triangles.push_back({{first, first + 1, first + 2}, 0});
  mesh.triangles.push_back({{first, first + 3, first + 4}, 0});
  const Welded welded = weld(mesh, Affine(1), coarse, colors);
  EXPECT_EQ(welded.surface.triangles.size(), 3u);
  EXPECT_EQ(welded.enlarged_triangles, 2u);
  EXPECT_EQ(welded.lone_triangles, 1u);
  EXPECT_EQ(welded.dropped_triangles, 11u);  // of the box
  for (const Triangle& triangle : welded.surface.triangles) {
    const auto& [a, b, c] = triangle.vertices;
    const auto& points = welded.surface.points;
    EXPECT_FALSE(degenerate(points[a], points[b], points[c]));
  }
  // Each vertex has a point of the surface within its rounding and a step.
  for (const glm::dvec3& vertex : mesh.positions) {
    double nearest = 1e9;
    for (const glm::ivec3& point : welded.surface.points)
      nearest = std::min(nearest, glm::length(coarse.position(point) - vertex));
    EXPECT_LE(nearest, 1 + coarse.rounding()) << vertex.x;
  }
}

TEST(Weld, what_has_no_area_from_the_start_is_not_enlarged) {
  const Mesh mesh{"m",
                  {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {9, 9, 9}, {12, 12, 12}, {10.5, 10.5, 10.5}},
                  {{{0, 1, 2}, 0}, {{3, 3, 3}, 0}, {{3, 4, 5}, 0}, {{3, 4, 4}, 0}}};
  const Welded welded = weld(mesh, Affine(1), lattice, colors);
  EXPECT_EQ(welded.surface.triangles.size(), 1u);
  EXPECT_EQ(welded.enlarged_triangles, 0u);
  EXPECT_EQ(welded.dropped_triangles, 3u);
}

TEST(Weld, materials_become_palette_entries) {
  Mesh mesh = awkward::box({0, 0, 0}, {1, 1, 1}, 2);
  const std::vector<uint32_t> others = {7, 8, 9};
  const Surface surface = weld(mesh, Affine(1), lattice, {others}).surface;
  for (const Triangle& triangle : surface.triangles) EXPECT_EQ(triangle.material, 9u);
}

TEST(Weld, where_two_colours_meet_is_one_point_and_the_corners_keep_theirs) {
  constexpr VertexColor red{255, 0, 0, 255}, blue{0, 0, 255, 255};
  Mesh mesh{"m",
            {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}},
            {{{0, 1, 2}, 0}, {{4, 3, 5}, 0}}};
  mesh.colors = {red, red, red, blue, blue, blue};
  const Surface surface = weld(mesh, Affine(1), lattice, of_corners).surface;
  EXPECT_EQ(surface.points.size(), 4u);
  EXPECT_EQ(surface.colors,
            (std::vector<SurfaceCorners>{CornerColors{red, red, red}, CornerColors{blue, blue, blue}}));
}

TEST(Weld, colours_stay_with_their_corners_where_triangles_are_mirrored_or_dropped) {
  constexpr VertexColor red{255, 0, 0, 255}, green{0, 255, 0, 255}, blue{0, 0, 255, 255};
  Mesh mesh{"m", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{{0, 1, 1}, 0}, {{0, 1, 2}, 0}, {{0, 1, 2}, 0}}};
  mesh.colors = {red, green, blue};
  Affine mirror(1);
  mirror[0].x = -1;
  const Surface surface = weld(mesh, mirror, lattice, of_corners).surface;
  ASSERT_EQ(surface.colors.size(), 1u);
  for (size_t k = 0; k < 3; ++k) {
    const glm::ivec3 point = surface.points[surface.triangles[0].vertices[k]];
    EXPECT_EQ(surface.colors[0][k], point.x != 0 ? green : point.y != 0 ? blue : red);
  }
}

TEST(Weld, vertex_colours_multiply_base_colours_in_linear_light_and_the_first_material_is_none) {
  const std::vector<Material> materials = {{}, {{0.5f, 1, 0.25f, 1}}};
  const VertexTint tint(materials);
  constexpr VertexColor grey{188, 188, 188, 255};  // about half in linear light
  EXPECT_EQ(tint({grey, grey, grey}, 0)[0], grey);
  const VertexColor drawn = tint({grey, grey, grey}, 1)[2];
  EXPECT_NEAR(drawn[0], 137, 1);  // a quarter
  EXPECT_EQ(drawn[1], 188);
  EXPECT_NEAR(drawn[2], 99, 1);  // an eighth
  EXPECT_EQ(tint({}, 1)[0], (VertexColor{188, 255, 137, 255}))
      << "a corner without a colour has the material's";
}

TEST(Weld, flat_colours_become_those_of_the_palette) {
  constexpr VertexColor red{255, 0, 0, 255}, blue{0, 0, 255, 255};
  const FlatColors flat = {{red, 7}, {blue, 4}};
  Mesh mesh{"m",
            {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}},
            {{{0, 1, 2}, 0}, {{4, 3, 5}, 0}}};
  mesh.colors = {red, red, red, blue, blue, blue};
  const Surface surface = weld(mesh, Affine(1), lattice, {palette_of_materials, &white, &flat}).surface;
  EXPECT_EQ(surface.points.size(), 4u);
  EXPECT_TRUE(surface.colors.empty());
  EXPECT_EQ(surface.triangles[0].material, 7u);
  EXPECT_EQ(surface.triangles[1].material, 4u);
}

}  // namespace
}  // namespace triptych
