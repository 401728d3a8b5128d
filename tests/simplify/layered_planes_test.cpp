// What lies in a plane with others stays in it at every level, however it is simplified.
#include "simplify/layered_planes.hpp"

#include "simplify/cover.hpp"
#include "simplify/edge_collapse.hpp"
#include "simplify/simplify.hpp"
#include "simplify/vertex_clustering.hpp"
#include "tests/support/awkward_meshes.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <random>

namespace triptych {
namespace {

constexpr uint32_t slab = 0, carpet = 1, clutter = 2;
constexpr int unit = 1024;  // steps

void add(Surface& all, const Surface& more) {
  const auto first = static_cast<uint32_t>(all.points.size());
  all.points.insert(all.points.end(), more.points.begin(), more.points.end());
  for (Triangle triangle : more.triangles) {
    for (uint32_t& vertex : triangle.vertices) vertex += first;
    all.triangles.push_back(triangle);
  }
}

/// A box whose upper face has the layer.
Surface box(const glm::dvec3& lo, const glm::dvec3& hi, uint32_t material, uint32_t layer) {
  Surface surface = awkward::surface_of(awkward::box(lo, hi, material));
  const int top = surface.box().hi.z;
  for (Triangle& triangle : surface.triangles) {
    const auto& [a, b, c] = triangle.vertices;
    if (surface.points[a].z == top && surface.points[b].z == top && surface.points[c].z == top)
      triangle.material = material_in_layer(material, layer);
  }
  return surface;
}

/// Carpets that are flush with the slab that they lie in, at z = 0, and small boxes above and below.
Surface room() {
  Surface all = box({-10, -10, -0.5}, {10, 10, 0}, slab, 2);
  for (int i = 0; i < 9; ++i) {
    const glm::dvec3 lo(6 * (i % 3) - 8, 6 * (i / 3) - 8, -0.125);
    add(all, box(lo, {lo.x + 4, lo.y + 4, 0}, carpet, 1));
  }
  std::mt19937 random(3);
  const auto number = [&](double lo, double hi) {
    return lo + (hi - lo) * static_cast<double>(random() % 10000) / 10000;
  };
  for (int i = 0; i < 300; ++i) {
    const glm::dvec3 at(number(-10, 10), number(-10, 10), i % 2 == 0 ? number(0.3, 4) : number(-4, -0.9));
    add(all, awkward::surface_of(awkward::box(at - 0.125, at + 0.125, clutter)));
  }
  return all;
}

double area(const Surface& surface, uint32_t material) {
  double sum = 0;
  for (const Triangle& triangle : surface.triangles) {
    if (triangle.material != material) continue;
    const auto at = [&](size_t k) { return glm::dvec3(surface.points[triangle.vertices[k]]); };
    sum += glm::length(glm::cross(at(1) - at(0), at(2) - at(0))) / 2;
  }
  return sum;
}

void expect_in_plane(const Surface& surface, const std::string& level) {
  for (const Triangle& triangle : surface.triangles) {
    bool flat = true;
    for (const uint32_t corner : triangle.vertices) {
      if (layer_of(triangle.material) > 0) {
        EXPECT_EQ(surface.points[corner].z, 0) << level;
      }
      flat = flat && surface.points[corner].z == 0;
    }
    EXPECT_TRUE(!flat || layer_of(triangle.material) > 0) << level << ": something else came to lie there";
  }
}

TEST(LayeredPlanes, hold_their_points_at_every_level_whoever_simplifies) {
  const Surface all = room();
  const double whole = area(all, material_in_layer(carpet, 1));
  for (const Simplifier simplifier : {Simplifier::collapse, Simplifier::openmesh, Simplifier::meshopt}) {
    for (const Colors colors : {Colors::keep, Colors::ignore}) {
      for (const bool cover : {false, true}) {
        SimplifyLimits limits;
        limits.triangles = 24;
        limits.simplifier = simplifier;
        limits.colors = colors;
        limits.keep_cover = cover;
        const Chain chain = simplify(all, {}, limits);
        ASSERT_FALSE(chain.levels.empty());
        size_t coarse = 0;
        for (const Level& level : chain.levels) {
          const std::string name = "simplifier " + std::to_string(static_cast<int>(simplifier)) + ", bound " +
                                   std::to_string(level.bound / unit);
          // Carpets reach over 16 x 16 units altogether.
          if (level.bound >= 22 * unit) continue;
          expect_in_plane(level.piece.surface, name);
          if (level.bound < 4 * unit) {
            EXPECT_GT(area(level.piece.surface, material_in_layer(carpet, 1)), whole * 0.7) << name;
          }
          coarse += level.bound > unit / 2;
        }
        EXPECT_GT(coarse, 0u) << "no level could have left the plane";
      }
    }
  }
}

TEST(LayeredPlanes, are_left_by_levels_that_are_off_by_as_much_as_all_that_lies_there) {
  const Surface all = room();
  SimplifyLimits limits;
  limits.triangles = 4;
  limits.colors = Colors::ignore;
  const Chain chain = simplify(all, {}, limits);
  EXPECT_LE(chain.levels.back().piece.surface.triangles.size(), 24u) << "they do not hold it up for ever";
  for (const Level& level : chain.levels) EXPECT_GE(level.bound, level.planes_left);
  EXPECT_GT(chain.levels.back().planes_left, 16 * unit);
}

TEST(LayeredPlanes, of_what_lies_there_alone_are_held_as_well) {
  // The slab is in another part of the hierarchy.
  Surface alone;
  for (int i = 0; i < 16; ++i) add(alone, box({i, 0, -0.125}, {i + 0.75, 0.75, 0}, carpet, 1));
  SimplifyLimits limits;
  limits.colors = Colors::ignore;
  const Chain chain = simplify(alone, {}, limits);
  ASSERT_FALSE(chain.levels.empty());
  for (const Level& level : chain.levels) {
    if (level.bound < 15 * unit) expect_in_plane(level.piece.surface, std::to_string(level.bound));
  }
}

/// Two sheets at right angles that meet in the y axis, both in layers.
Surface corner() {
  Surface all;
  all.points = {{0, 0, 0},    {0, 4096, 0},    {4096, 0, 0}, {4096, 4096, 0},
                {0, 0, 4096}, {0, 4096, 4096}, {0, 2048, 0}, {9000, 9000, 9000}};
  const uint32_t flat = material_in_layer(slab, 1), upright = material_in_layer(carpet, 2);
  all.triangles = {{{0, 2, 6}, flat},    {{2, 3, 6}, flat},    {{6, 3, 1}, flat},   {{0, 6, 4}, upright},
                   {{6, 5, 4}, upright}, {{6, 1, 5}, upright}, {{3, 7, 5}, clutter}};
  return all;
}

TEST(LayeredPlanes, that_meet_hold_their_points_to_the_line) {
  const LayeredPlanes planes(corner());
  ASSERT_FALSE(planes.empty());
  EXPECT_EQ(planes.planes_of(6).size(), 2u);
  EXPECT_EQ(planes.planes_of(2).size(), 1u);
  EXPECT_EQ(planes.planes_of(7).size(), 0u);
  EXPECT_EQ(planes.left(6, 0), 0) << "along the line";
  EXPECT_GT(planes.left(6, 2), 4096) << "into one of both planes";
  EXPECT_EQ(planes.left(2, 6), 0);
  EXPECT_GT(planes.left(2, 7), 4096);
  EXPECT_EQ(planes.left(7, 2), 0);
  EXPECT_GT(planes.entered(7, 2, 3, 1), 0) << "a triangle comes to lie in the plane";
  EXPECT_EQ(planes.entered(7, 2, 3, 4), 0);
  const auto close = [](const glm::dvec3& a, const glm::dvec3& b) { return glm::distance(a, b) < 1e-9; };
  EXPECT_TRUE(close(planes.within(6, {3, 5, 7}), {0, 5, 0}));
  EXPECT_TRUE(close(planes.within(2, {3, 5, 7}), {3, 5, 0}));
  EXPECT_TRUE(close(planes.within(7, {3, 5, 7}), {3, 5, 7}));
}

TEST(LayeredPlanes, that_are_turned_are_found_although_points_were_rounded) {
  Surface turned = room();
  const glm::dvec3 x = glm::normalize(glm::dvec3(3, 1, 0.4)), z = glm::normalize(glm::cross(x, {0.2, 1, 5}));
  const glm::dmat3 turn(x, glm::cross(z, x), z);
  for (glm::ivec3& point : turned.points) point = glm::ivec3(glm::round(turn * glm::dvec3(point)));
  const LayeredPlanes planes(turned);
  size_t held = 0;
  for (uint32_t i = 0; i < turned.points.size(); ++i) {
    held += !planes.planes_of(i).empty();
    for (const uint32_t plane : planes.planes_of(i)) {
      EXPECT_EQ(plane, 0u);
      EXPECT_LT(std::abs(planes.height(plane, turned.points[i])), 2);
    }
  }
  EXPECT_EQ(held, 40u) << "four corners of the slab and of each carpet";
  EXPECT_EQ(LayeredPlanes(awkward::surface_of(awkward::sphere(8))).empty(), true);
}

}  // namespace
}  // namespace triptych
