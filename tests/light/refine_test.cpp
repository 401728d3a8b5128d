#include "light/refine.hpp"

#include "light/split_edges.hpp"
#include "tests/light/rooms.hpp"

#include <gtest/gtest.h>
#include <map>

namespace triptych::test {
namespace {

/// How often each edge occurs, by its places.
std::map<uint64_t, int> edges_of(const LitModel& model) {
  std::map<uint64_t, int> edges;
  for (const LitTriangle& triangle : model.triangles)
    for (size_t k = 0; k < 3; ++k)
      ++edges[edge_key(triangle.corners[k].place, triangle.corners[(k + 1) % 3].place)];
  return edges;
}

double area_of(const LitModel& model) {
  double area = 0;
  for (const LitTriangle& triangle : model.triangles) area += glm::length(model.normal(triangle)) / 2;
  return area;
}

/// A floor under a light, and a board between that throws a shadow.
Model shadow() {
  Model model = floor_model(1);
  Mesh board;
  add_rectangle(board, {-0.5, 0.5, 0.5}, {1, 0, 0}, {0, 0, -1}, 1, 1, 0);
  model.meshes.push_back(board);
  model.instances.push_back({1, Affine(1)});
  model.lights = {point_light({0, 2, 0}, 100)};
  return model;
}

LightOptions options_with(double threshold, double shortest) {
  LightOptions options;
  options.bake = true;
  options.samples = 16;
  options.bounces = 0;
  options.threshold = threshold;
  options.shortest_edge = shortest;
  options.longest_edge = 0.25;
  return options;
}

TEST(Refine, closed_surfaces_stay_closed_whatever_edges_are_divided) {
  const Model model = inside_of_box(4, grey(0.5f));
  LitModel lit = place_all(model, uint64_t{1} << 30);
  const double area = area_of(lit);
  for (int round = 0; round < 4; ++round) {
    std::vector<uint64_t> divided;
    size_t i = 0;
    for (const auto& [edge, count] : edges_of(lit))
      if ((i++ * 2654435761u >> 7) % 3 == 0) divided.push_back(edge);
    split_edges(lit, divided);
    for (const auto& [edge, count] : edges_of(lit)) ASSERT_EQ(count, 2) << round;
    EXPECT_NEAR(area_of(lit), area, 1e-9);
  }
}

TEST(Refine, edges_are_divided_where_a_shadow_ends_and_not_where_light_is_even) {
  const Model model = shadow();
  const LightBake bake(model, options_with(0.05, 1.0 / 128), {}, run_points);
  const LitModel& lit = bake.model();
  double at_rim = 1e9, elsewhere = 0;
  for (const LitTriangle& triangle : lit.triangles) {
    if (triangle.instance != 0) continue;
    const glm::dvec3 middle =
        (lit.at(triangle.corners[0]) + lit.at(triangle.corners[1]) + lit.at(triangle.corners[2])) / 3.0;
    const double from_middle = std::max(std::abs(middle.x), std::abs(middle.z));
    const double size = std::sqrt(glm::length(lit.normal(triangle)));
    const double rim = 0.5 * 2 / 1.5;  // the board's, seen from the light on the floor
    if (std::abs(from_middle - rim) < 0.02) at_rim = std::min(at_rim, size);
    if (from_middle < 0.3) elsewhere = std::max(elsewhere, size);
  }
  EXPECT_LT(at_rim, 0.1);
  EXPECT_GT(elsewhere, 3 * at_rim);
}

TEST(Refine, converges_to_the_light_between_vertices) {
  const Model model = shadow();
  // The mean difference between interpolated light and that of the point light, over the floor.
  const auto error = [&](double threshold, double shortest) {
    const LightBake bake(model, options_with(threshold, shortest), {}, run_points);
    const PointLight light = bake.gather(16, 0, run_points);
    const LitModel& lit = bake.model();
    double sum = 0, area = 0;
    for (const LitTriangle& triangle : lit.triangles) {
      if (triangle.instance != 0) continue;
      glm::dvec3 middle(0);
      double interpolated = 0;
      for (const LitCorner& corner : triangle.corners) {
        middle += lit.at(corner) / 3.0;
        interpolated += light.irradiance[corner.point].g / 3.0;
      }
      const glm::dvec3 way = model.lights[0].position - middle;
      const glm::dvec3 at_board = middle + way * ((0.5 - middle.y) / way.y);
      const bool dark = std::max(std::abs(at_board.x), std::abs(at_board.z)) < 0.5;
      const double expected = dark ? 0 : 100 * way.y / std::pow(glm::length(way), 3);
      const double own = glm::length(lit.normal(triangle)) / 2;
      sum += std::abs(interpolated - expected) * own;
      area += own;
    }
    return sum / area;
  };
  const double coarse = error(0.2, 1.0 / 16), fine = error(0.05, 1.0 / 64), finest = error(0.02, 1.0 / 256);
  EXPECT_LT(fine, 0.5 * coarse);
  EXPECT_LT(finest, 0.5 * fine);
}

TEST(Refine, objects_that_touch_are_divided_alike) {
  Model model = floor_model(2);
  Mesh wall;  // its lower edge is that of the floor
  add_rectangle(wall, {-2, 0, -2}, {4, 0, 0}, {0, 2, 0}, 2, 1, 0);
  model.meshes.push_back(wall);
  model.instances.push_back({1, Affine(1)});
  model.lights = {point_light({0, 0.4, -1.5}, 100)};
  const LightBake bake(model, options_with(0.05, 1.0 / 128), {}, run_points);
  std::map<uint64_t, std::array<int, 2>> edges;  // of the two, where they meet
  const LitModel& lit = bake.model();
  for (const LitTriangle& triangle : lit.triangles) {
    for (size_t k = 0; k < 3; ++k) {
      const LitCorner &a = triangle.corners[k], &b = triangle.corners[(k + 1) % 3];
      const auto meets = [&](const LitCorner& c) { return lit.at(c).y == 0 && lit.at(c).z == -2; };
      if (meets(a) && meets(b)) ++edges[edge_key(a.place, b.place)][triangle.instance];
    }
  }
  EXPECT_GT(edges.size(), 4u);
  for (const auto& [edge, counts] : edges) EXPECT_EQ(counts, (std::array<int, 2>{1, 1}));
}

}  // namespace
}  // namespace triptych::test
