// Colours of corners through simplification: regions keep their outlines, gradients their course, and no
// colour appears that was not there.
#include "simplify/color_charts.hpp"
#include "simplify/simplify.hpp"
#include "tests/support/awkward_meshes.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <gtest/gtest.h>
#include <set>

namespace triptych {
namespace {

constexpr uint32_t cells = 32;

/// A flat plate of cells, one unit of the lattice's thousand each, whose corners are coloured by
/// color(triangle's middle, corner), both in cells.
template <typename Color>
Surface painted(const Color& color) {
  Surface surface = awkward::surface_of(awkward::grid(cells, cells));
  for (const Triangle& triangle : surface.triangles) {
    glm::dvec3 middle(0);
    for (const uint32_t vertex : triangle.vertices)
      middle += glm::dvec3(surface.points[vertex]) / (3 * 1024.0);
    SurfaceCorners& colors = surface.colors.emplace_back();
    for (size_t k = 0; k < 3; ++k)
      colors[k] = color(middle, glm::dvec3(surface.points[triangle.vertices[k]]) / 1024.0);
  }
  return surface;
}

VertexColor field(const glm::dvec3& at) {
  return (static_cast<int>(at.x / 8) + static_cast<int>(at.y / 8)) % 2 == 0 ? VertexColor{200, 30, 20, 255}
                                                                            : VertexColor{20, 40, 220, 255};
}

/// Fields of eight cells; every triangle has one colour.
Surface checkers() {
  return painted([](const glm::dvec3& middle, const glm::dvec3&) { return field(middle); });
}

/// The same painted onto shared corners: colours pass into each other within a cell.
Surface soft_checkers() {
  return painted([](const glm::dvec3&, const glm::dvec3& corner) { return field(corner); });
}

Surface gradient() {
  return painted([](const glm::dvec3&, const glm::dvec3& corner) {
    return VertexColor{static_cast<uint8_t>(6 * corner.x), static_cast<uint8_t>(250 - 7 * corner.y), 90, 255};
  });
}

glm::dvec3 channels(const VertexColor& color) { return {color[0], color[1], color[2]}; }

/// What the plate shows at a place in cells; nullopt where it has a hole.
std::optional<glm::dvec3> shown(const Surface& surface, const glm::dvec2& cell) {
  const glm::dvec2 at = cell * 1024.0;
  for (size_t t = 0; t < surface.triangles.size(); ++t) {
    std::array<glm::dvec2, 3> corners;
    for (size_t k = 0; k < 3; ++k) corners[k] = glm::dvec2(surface.points[surface.triangles[t].vertices[k]]);
    const auto cross = [](const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; };
    const double area = cross(corners[1] - corners[0], corners[2] - corners[0]);
    std::array<double, 3> weights;
    for (size_t k = 0; k < 3; ++k)
      weights[k] = cross(corners[(k + 1) % 3] - at, corners[(k + 2) % 3] - at) / area;
    if (*std::min_element(weights.begin(), weights.end()) < 0) continue;
    glm::dvec3 color(0);
    for (size_t k = 0; k < 3; ++k) color += weights[k] * channels(surface.colors[t][k].color);
    return color;
  }
  return std::nullopt;
}

/// The largest difference of a channel between two plates, at the middles of half cells.
double difference(const Surface& a, const Surface& b) {
  double most = 0;
  for (double y = 0.26; y < cells; y += 0.5) {
    for (double x = 0.31; x < cells; x += 0.5) {
      const auto left = shown(a, {x, y}), right = shown(b, {x, y});
      if (!left || !right) return 1000;
      const glm::dvec3 gap = glm::abs(*left - *right);
      most = std::max({most, gap.x, gap.y, gap.z});
    }
  }
  return most;
}

std::vector<Level> levels(const Surface& surface, double max_bound,
                          Simplifier simplifier = Simplifier::collapse) {
  return simplify(surface, {}, {.triangles = 2, .max_bound = max_bound, .simplifier = simplifier}).levels;
}

TEST(ColorCharts, fields_of_one_colour_are_told_apart_and_gradients_are_not) {
  EXPECT_EQ(color_charts(checkers()).materials.size(), 16u);
  EXPECT_EQ(color_charts(soft_checkers()).materials.size(), 1u);
  EXPECT_EQ(color_charts(gradient()).materials.size(), 1u);
}

TEST(ColoredCollapse, fields_of_one_colour_keep_their_outlines_at_no_cost) {
  const Surface surface = checkers();
  const std::vector<Level> chain = levels(surface, 1e-3);
  ASSERT_FALSE(chain.empty());
  // Sixteen fields: two triangles each suffice.
  EXPECT_LE(chain.back().piece.surface.triangles.size(), 64u);
  EXPECT_LT(difference(surface, chain.back().piece.surface), 1);
}

TEST(ColoredCollapse, fields_keep_their_outlines_under_every_simplifier) {
  const Surface surface = checkers();
  for (const Simplifier simplifier : {Simplifier::openmesh, Simplifier::meshopt}) {
    const std::vector<Level> chain = levels(surface, 1e-3, simplifier);
    ASSERT_FALSE(chain.empty());
    EXPECT_LT(difference(surface, chain.back().piece.surface), 1);
  }
}

TEST(ColoredCollapse, a_gradient_costs_a_plate_next_to_nothing) {
  const Surface surface = gradient();
  const std::vector<Level> chain = levels(surface, 8 * 1024);
  ASSERT_FALSE(chain.empty());
  EXPECT_LE(chain.back().piece.surface.triangles.size(), 16u);
  EXPECT_LT(difference(surface, chain.back().piece.surface), distinct_colors / 2);
}

TEST(ColoredCollapse, what_is_painted_on_a_plate_stays_while_the_bound_is_below_its_size) {
  const Surface surface = soft_checkers();
  bool smaller = false;
  for (const Level& level : levels(surface, 1.01 * 1024)) {
    // A cell's width of transition, and the bound's, may look another way; the middles of fields may not.
    for (double y = 4; y < cells; y += 8) {
      for (double x = 4; x < cells; x += 8) {
        for (const glm::dvec2 aside : {glm::dvec2(0, 0), {-1.9, 1.1}, {1.3, 1.8}}) {
          const auto found = shown(level.piece.surface, glm::dvec2(x, y) + aside);
          const VertexColor wanted = field({x, y, 0});
          ASSERT_TRUE(found.has_value());
          EXPECT_NEAR(found->x, wanted[0], distinct_colors);
          EXPECT_NEAR(found->z, wanted[2], distinct_colors);
        }
      }
    }
    smaller = smaller || level.piece.surface.triangles.size() < surface.triangles.size() / 2;
  }
  EXPECT_TRUE(smaller) << "colours must not keep a plate from being simplified";
}

TEST(ColoredCollapse, no_colour_appears_that_was_not_there) {
  for (const Surface& surface : {checkers(), soft_checkers(), gradient()}) {
    std::set<VertexColor> known;
    for (const SurfaceCorners& colors : surface.colors)
      for (const SurfaceCorner& corner : colors) known.insert(corner.color);
    for (const Level& level : levels(surface, 1e300)) {
      ASSERT_EQ(level.piece.surface.colors.size(), level.piece.surface.triangles.size());
      for (const SurfaceCorners& colors : level.piece.surface.colors) {
        for (const SurfaceCorner& corner : colors) EXPECT_TRUE(known.contains(corner.color));
      }
    }
  }
}

}  // namespace
}  // namespace triptych
