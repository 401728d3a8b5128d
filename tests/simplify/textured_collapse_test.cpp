// Places on textures through simplification: the texture stays where it was on the surface, to within the
// bound, and seams stay.
#include "simplify/simplify.hpp"
#include "tests/support/awkward_meshes.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace triptych {
namespace {

constexpr uint32_t cells = 32;
constexpr double cell = 1024;  ///< steps of the lattice

/// A flat plate of cells, whose corners have the places of(triangle's middle, corner), both in cells.
template <typename Place>
Surface textured(const Place& of) {
  Surface surface = awkward::surface_of(awkward::grid(cells, cells));
  for (const Triangle& triangle : surface.triangles) {
    glm::dvec3 middle(0);
    for (const uint32_t vertex : triangle.vertices) middle += glm::dvec3(surface.points[vertex]) / (3 * cell);
    SurfaceCorners& corners = surface.colors.emplace_back();
    for (size_t k = 0; k < 3; ++k) {
      const glm::dvec2 at = of(middle, glm::dvec3(surface.points[triangle.vertices[k]]) / cell);
      corners[k].coordinates = texture_coordinates(at.x, at.y);
    }
  }
  return surface;
}

/// The farthest that any corner's place is from of(corner), in cells; scale: what a cell is on the texture.
template <typename Place>
double furthest(const Surface& surface, const Place& of, double scale) {
  double most = 0;
  for (size_t t = 0; t < surface.triangles.size(); ++t) {
    glm::dvec3 middle(0);
    for (const uint32_t vertex : surface.triangles[t].vertices)
      middle += glm::dvec3(surface.points[vertex]) / (3 * cell);
    for (size_t k = 0; k < 3; ++k) {
      const glm::dvec2 at = of(middle, glm::dvec3(surface.points[surface.triangles[t].vertices[k]]) / cell);
      const TextureCoordinates& found = surface.colors[t][k].coordinates;
      most = std::max(most, glm::length(glm::dvec2(found.u, found.v) / 65536.0 - at) / scale);
    }
  }
  return most;
}

TEST(TexturedCollapse, a_plane_over_which_a_texture_runs_evenly_loses_its_triangles_and_keeps_it_exactly) {
  const auto even = [](const glm::dvec3&, const glm::dvec3& corner) {
    return glm::dvec2(0.25 * corner.x + 0.1 * corner.y, 0.5 - 0.2 * corner.y);
  };
  const Surface plate = textured(even);
  const Chain chain = simplify(plate, {}, {.triangles = 4});
  ASSERT_FALSE(chain.levels.empty());
  const Level& last = chain.levels.back();
  EXPECT_LE(last.piece.surface.triangles.size(), 16u);
  EXPECT_LT(last.bound, 1) << "nothing moved";
  EXPECT_LT(furthest(last.piece.surface, even, 0.25), 1e-3);
}

TEST(TexturedCollapse, where_a_texture_is_warped_bounds_hold_how_far_it_moves) {
  const auto warped = [](const glm::dvec3&, const glm::dvec3& corner) {
    return glm::dvec2(0.1 * corner.x + 0.05 * std::sin(corner.x * 0.6), 0.1 * corner.y);
  };
  const Surface plate = textured(warped);
  const Chain chain = simplify(plate, {}, {.triangles = 16});
  ASSERT_GE(chain.levels.size(), 2u);
  double finest = 0;
  constexpr double rounding = 0.25;  // of coordinates, in steps of the lattice
  for (const Level& level : chain.levels) {
    // Where a point of the level shows the texture that the plate has elsewhere: how far away is that?
    double off = 0;
    const Surface& surface = level.piece.surface;
    for (size_t t = 0; t < surface.triangles.size(); ++t) {
      glm::dvec2 place(0), at(0);
      for (size_t k = 0; k < 3; ++k) {
        const TextureCoordinates& own = surface.colors[t][k].coordinates;
        at += glm::dvec2(own.u, own.v) / (3 * 65536.0);
        place += glm::dvec2(surface.points[surface.triangles[t].vertices[k]]) / (3 * cell);
      }
      // Between the plate's own corners it runs evenly.
      const double low = std::floor(place.x);
      const glm::dvec2 there =
          glm::mix(warped({}, {low, place.y, 0}), warped({}, {low + 1, place.y, 0}), place.x - low);
      off = std::max(off, std::abs(there.x - at.x) / 0.13);  // where the texture is stretched least
    }
    EXPECT_LE(off * cell, level.bound * 1.01 + rounding) << surface.triangles.size() << " triangles";
    finest = finest == 0 ? level.bound : finest;
  }
  EXPECT_GT(chain.levels.back().bound, finest) << "it counts";
  EXPECT_GT(chain.levels.back().bound, 0.01 * cell);
}

TEST(TexturedCollapse, seams_stay_where_they_are) {
  constexpr double seam = 13;
  const auto torn = [](const glm::dvec3& middle, const glm::dvec3& corner) {
    return glm::dvec2(0.1 * corner.x + (middle.x < seam ? 0 : 5), 0.1 * corner.y);
  };
  const Surface plate = textured(torn);
  const Chain chain = simplify(plate, {}, {.triangles = 4, .max_bound = 0.25 * cell});
  ASSERT_FALSE(chain.levels.empty());
  const Surface& last = chain.levels.back().piece.surface;
  EXPECT_LE(last.triangles.size(), 40u) << "along the seam points go as they do at a border";
  EXPECT_LT(furthest(last, torn, 0.1), 1e-3) << "no triangle reaches across it";
}

}  // namespace
}  // namespace triptych
