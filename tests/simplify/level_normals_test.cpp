// What corners of coarse levels show of the surface that they stand for.
#include "simplify/level_normals.hpp"

#include "simplify/simplify.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <numbers>
#include <numeric>

namespace triptych {
namespace {

constexpr int unit = 1 << 12;

/// The side of a cylinder along z, of so many flat strips, and so many triangles long.
Surface cylinder(int sides, int rings) {
  Surface surface;
  for (int ring = 0; ring <= rings; ++ring) {
    for (int i = 0; i < sides; ++i) {
      const double angle = 2 * std::numbers::pi * i / sides;
      surface.points.emplace_back(std::lround(unit * std::cos(angle)), std::lround(unit * std::sin(angle)),
                                  ring * unit / 2);
    }
  }
  const auto at = [&](int ring, int i) { return static_cast<uint32_t>(ring * sides + i % sides); };
  for (int ring = 0; ring < rings; ++ring) {
    for (int i = 0; i < sides; ++i) {
      surface.triangles.push_back({{at(ring, i), at(ring, i + 1), at(ring + 1, i + 1)}, 0});
      surface.triangles.push_back({{at(ring, i), at(ring + 1, i + 1), at(ring + 1, i)}, 0});
    }
  }
  return surface;
}

/// What the radius says at a point of the cylinder.
glm::dvec3 outward(const glm::ivec3& point) { return glm::normalize(glm::dvec3(point.x, point.y, 0)); }

Piece whole(const Surface& surface) {
  Piece piece{surface, std::vector<uint32_t>(surface.points.size())};
  std::iota(piece.sources.begin(), piece.sources.end(), 0u);
  return piece;
}

TEST(LevelNormals, of_a_coarse_cylinder_are_those_of_the_fine_one) {
  const Surface fine = cylinder(48, 6);
  Chain chain = simplify(fine, {}, {.triangles = 40});
  ASSERT_FALSE(chain.levels.empty());
  LevelNormals normals(fine);
  Piece& coarse = chain.levels.back().piece;
  normals.shade(coarse, chain.levels.back().bound);
  ASSERT_EQ(coarse.surface.normals.size(), coarse.surface.triangles.size());
  size_t shaded = 0;
  for (size_t t = 0; t < coarse.surface.triangles.size(); ++t) {
    if (!has_normal(coarse.surface.normals[t][0])) continue;
    ++shaded;
    for (size_t k = 0; k < 3; ++k) {
      const glm::dvec3 own = glm::normalize(direction_of(coarse.surface.normals[t][k]));
      const glm::ivec3& point = coarse.surface.points[coarse.surface.triangles[t].vertices[k]];
      EXPECT_GT(glm::dot(own, outward(point)), std::cos(glm::radians(5.0))) << "triangle " << t;
    }
  }
  EXPECT_GT(shaded, coarse.surface.triangles.size() / 2);
  EXPECT_FALSE(coarse.surface.file_normals);
}

TEST(LevelNormals, are_none_where_triangles_of_the_source_stay_and_where_they_are_merged_in_a_plane) {
  const Surface source = cylinder(8, 4);  // 45 degrees: facets, and no cylinder
  Piece same = whole(source);
  LevelNormals(source).shade(same, 0);
  EXPECT_TRUE(same.surface.normals.empty());
  // Its strips as two triangles each.
  Chain chain = simplify(source, {}, {.triangles = 16, .max_bound = 1});
  ASSERT_FALSE(chain.levels.empty());
  LevelNormals(source).shade(chain.levels.back().piece, chain.levels.back().bound);
  EXPECT_TRUE(chain.levels.back().piece.surface.normals.empty());
}

TEST(LevelNormals, of_a_source_that_has_its_own_are_those) {
  Surface source = cylinder(12, 6);
  for (const Triangle& triangle : source.triangles) {
    CornerNormals& own = source.normals.emplace_back();
    for (size_t k = 0; k < 3; ++k) own[k] = to_vertex_normal(outward(source.points[triangle.vertices[k]]));
  }
  source.file_normals = true;
  Piece same = whole(source);
  LevelNormals(source).shade(same, 0);
  EXPECT_EQ(same.surface.normals, source.normals);
  EXPECT_TRUE(same.surface.file_normals);
  Chain chain = simplify(source, {}, {.triangles = 12});
  ASSERT_FALSE(chain.levels.empty());
  Surface& coarse = chain.levels.back().piece.surface;
  LevelNormals(source).shade(chain.levels.back().piece, chain.levels.back().bound);
  ASSERT_EQ(coarse.normals.size(), coarse.triangles.size());
  for (size_t t = 0; t < coarse.triangles.size(); ++t) {
    for (size_t k = 0; k < 3 && has_normal(coarse.normals[t][k]); ++k) {
      const glm::dvec3 own = glm::normalize(direction_of(coarse.normals[t][k]));
      EXPECT_GT(glm::dot(own, outward(coarse.points[coarse.triangles[t].vertices[k]])), 0.9999);
    }
  }
}

TEST(LevelNormals, that_say_what_facets_say_are_dropped) {
  Surface surface = cylinder(6, 1);
  const auto facet = [&](const Triangle& triangle) {
    const glm::dvec3 a(surface.points[triangle.vertices[0]]), b(surface.points[triangle.vertices[1]]),
        c(surface.points[triangle.vertices[2]]);
    return glm::cross(b - a, c - a);
  };
  for (const Triangle& triangle : surface.triangles) {
    CornerNormals& own = surface.normals.emplace_back();
    own.fill(to_vertex_normal(facet(triangle)));
  }
  surface.file_normals = true;
  Surface plain = surface;
  drop_plain_normals(plain);
  EXPECT_TRUE(plain.normals.empty());
  EXPECT_FALSE(plain.file_normals);
  // One that is turned to the other side says the same; one that leans by ten degrees does not.
  surface.normals[0].fill(to_vertex_normal(-facet(surface.triangles[0])));
  surface.normals[1][2] = to_vertex_normal(glm::normalize(facet(surface.triangles[1])) +
                                           glm::dvec3(0, 0, std::tan(glm::radians(10.0))));
  drop_plain_normals(surface);
  ASSERT_EQ(surface.normals.size(), surface.triangles.size());
  for (size_t t = 0; t < surface.normals.size(); ++t) EXPECT_EQ(has_normal(surface.normals[t][0]), t == 1);
  EXPECT_TRUE(surface.file_normals);
}

}  // namespace
}  // namespace triptych
