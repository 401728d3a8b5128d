// Prisms, antiprisms and tetrahedra in place of small convex things.
#include "simplify/stand_ins.hpp"

#include "simplify/simplify.hpp"
#include "simplify/stand_in_shapes.hpp"
#include "tests/support/awkward_meshes.hpp"
#include "tests/support/distance_judge.hpp"
#include "tests/support/wires.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <set>

namespace triptych {
namespace {

using namespace test;

constexpr double any = 1e300;

/// Turned and moved, so that nothing lies along an axis.
Surface turned(Surface surface) {
  for (glm::ivec3& point : surface.points) {
    const glm::dvec3 p(point);
    point = glm::ivec3(glm::round(glm::dvec3(0.8 * p.x - 0.6 * p.y, 0.48 * p.x + 0.64 * p.y - 0.6 * p.z,
                                             0.36 * p.x + 0.48 * p.y + 0.8 * p.z))) +
            glm::ivec3(5000, -70000, 123);
  }
  return surface;
}

bool is_closed(const Surface& surface) {
  std::map<std::pair<uint32_t, uint32_t>, int> sides;
  for (const auto& [v, material] : surface.triangles) {
    for (size_t k = 0; k < 3; ++k) ++sides[{v[k], v[(k + 1) % 3]}];
  }
  return std::ranges::all_of(sides, [&](const auto& side) {
    return side.second == 1 && sides.contains({side.first.second, side.first.first});
  });
}

double volume(const Surface& surface) {
  double six = 0;
  for (const auto& [v, material] : surface.triangles) {
    const auto at = [&](size_t k) { return glm::dvec3(surface.points[v[k]] - surface.points[0]); };
    six += glm::dot(at(0), glm::cross(at(1), at(2)));
  }
  return six / 6;
}

void append(const Surface& more, const glm::ivec3& moved, Surface& all) {
  const auto first = static_cast<uint32_t>(all.points.size());
  for (const glm::ivec3& point : more.points) all.points.push_back(point + moved);
  for (Triangle triangle : more.triangles) {
    for (uint32_t& vertex : triangle.vertices) vertex += first;
    all.triangles.push_back(triangle);
  }
}

/// Held where x is 0: the first ring of a wire().
std::vector<uint8_t> held_end(const Surface& surface, int sides = 8) {
  std::vector<uint8_t> locked(surface.points.size(), 0);
  std::fill_n(locked.begin(), sides, 1);
  return locked;
}

TEST(StandIns, of_a_bolt_get_simpler_cover_about_as_much_and_are_as_near_as_they_say) {
  struct Case {
    double length;
    bool stands;
    std::vector<size_t> counts;
    double cover;
  };
  for (const auto& [length, stands, expected, cover] :
       {Case{1.2, false, {12}, 0.92}, Case{1.2, true, {12}, 0.92}, Case{12, false, {8, 4}, 1}}) {
    const Surface bolt = turned(wire(length, 1, 2, 8));
    const auto found = convex_components(bolt, stands ? held_end(bolt) : std::vector<uint8_t>(), any);
    ASSERT_EQ(found.size(), 1);
    EXPECT_EQ(found[0].triangles.size(), bolt.triangles.size());
    std::vector<size_t> counts;
    for (const StandIn& stand_in : found[0].stand_ins) {
      const Surface& surface = stand_in.piece.surface;
      counts.push_back(surface.triangles.size());
      EXPECT_TRUE(is_closed(surface));
      EXPECT_GT(volume(surface), 0);
      EXPECT_NEAR(area(surface) / area(bolt), cover, 0.01);
      const double distance = judge::distance(bolt, surface);
      EXPECT_LE(distance, stand_in.bound);
      EXPECT_GE(distance, stand_in.bound * 0.8) << "the bound is loose";
      EXPECT_LT(stand_in.bound, 1536) << "further than it is large";
      const std::set<uint32_t> sources(stand_in.piece.sources.begin(), stand_in.piece.sources.end());
      EXPECT_EQ(sources.size(), surface.points.size()) << "a point stands for two";
      EXPECT_LT(*sources.rbegin(), bolt.points.size());
    }
    EXPECT_EQ(counts, expected);
  }
}

TEST(StandIns, of_what_stands_on_a_plane_stay_there) {
  Surface bolt = wire(1.2, 1, 2, 8);
  for (Triangle& triangle : bolt.triangles) {
    const bool below =
        std::ranges::all_of(triangle.vertices, [&](uint32_t vertex) { return bolt.points[vertex].x == 0; });
    if (below) triangle.material = material_in_layer(triangle.material, 2);
  }
  const auto found = convex_components(bolt, held_end(bolt), any);
  ASSERT_EQ(found.size(), 1);
  ASSERT_EQ(found[0].stand_ins.size(), 1);
  for (const StandIn& stand_in : found[0].stand_ins) {
    const Surface& surface = stand_in.piece.surface;
    EXPECT_EQ(surface.box().lo.x, 0);
    for (const Triangle& triangle : surface.triangles) {
      const bool below = std::ranges::all_of(triangle.vertices,
                                             [&](uint32_t vertex) { return surface.points[vertex].x == 0; });
      EXPECT_EQ(layer_of(triangle.material), below ? 2 : 0);
      EXPECT_EQ(palette_index(triangle.material), 1);
    }
    for (const uint32_t source : stand_in.piece.sources) EXPECT_GE(source, 8) << "a held point moved";
  }
}

TEST(StandIns, are_not_for_what_is_open_hollow_colourful_or_held_on_two_sides) {
  const Surface bolt = wire(1.2, 1, 2, 8);
  ASSERT_EQ(convex_components(bolt, {}, any).size(), 1);
  EXPECT_TRUE(convex_components(bolt, {}, 1).empty()) << "none is as near as a step";
  const size_t all = bolt.triangles.size();
  EXPECT_EQ(convex_components(bolt, {}, any, all).size(), 1);
  EXPECT_TRUE(convex_components(bolt, {}, any, all + 1).empty()) << "fewer than are worth it";
  Surface open = bolt;
  open.triangles.pop_back();
  EXPECT_TRUE(convex_components(open, {}, any).empty());
  Surface hollow = bolt;
  hollow.points[0] = {300, 0, 0};
  EXPECT_TRUE(convex_components(hollow, {}, any).empty());
  Surface colourful = bolt;
  colourful.triangles[3].material = 2;
  EXPECT_TRUE(convex_components(colourful, {}, any).empty());
  Surface coloured = bolt;
  coloured.colors.resize(bolt.triangles.size());
  EXPECT_TRUE(convex_components(coloured, {}, any).empty());
  std::vector<uint8_t> both = held_end(bolt);
  both.back() = 1;
  EXPECT_TRUE(convex_components(bolt, both, any).empty());
  const Surface rod = wire(12, 1, 2, 8);
  EXPECT_TRUE(convex_components(rod, held_end(rod), any).empty()) << "a rod that stands on something";
  EXPECT_TRUE(convex_components(awkward::surface_of(awkward::box({0, 0, 0}, {1, 1, 1}, 1)), {}, any).empty())
      << "a box has few triangles already";
}

/// Whether each corner of one ring lies over the middle of a side of the other, and not over a corner.
bool is_antiprism(const Surface& surface) {
  return std::ranges::none_of(surface.points, [&](const glm::ivec3& a) {
    return std::ranges::any_of(surface.points, [&](const glm::ivec3& b) {
      return a.x != b.x && std::hypot(a.y - b.y, a.z - b.z) < 64;
    });
  });
}

TEST(StandIns, are_antiprisms_for_what_is_round_and_prisms_for_what_is_like_a_box) {
  for (const int sides : {4, 8}) {
    Surface body = wire(1.2, 1, 4, sides);
    // Twice as wide as high; of four sides: a box, with more triangles than it needs.
    for (glm::ivec3& point : body.points) point = {point.x, 2 * (point.y - point.z), point.y + point.z};
    const auto found = convex_components(body, held_end(body, sides), any);
    ASSERT_EQ(found.size(), 1);
    EXPECT_EQ(is_antiprism(found[0].stand_ins.at(0).piece.surface), sides == 8) << sides;
  }
}

TEST(StandIns, differ_from_themselves_by_nothing_and_from_what_is_larger_all_round_by_how_much) {
  const std::vector<glm::ivec3> one = {{1000, 0, 0}, {-1000, 0, 0}, {0, 1000, 0}, {0, -1000, 0}};
  std::vector<glm::ivec3> twice = one;
  for (glm::ivec3& point : twice) point *= 2;
  EXPECT_EQ(mean_difference(one, one), 0);
  EXPECT_GT(mean_difference(one, twice), 500);
  EXPECT_LT(mean_difference(one, twice), 1000);
}

TEST(StandIns, of_what_is_inside_out_are_too) {
  Surface bolt = wire(1.2, 1, 2, 8);
  for (Triangle& triangle : bolt.triangles) std::swap(triangle.vertices[1], triangle.vertices[2]);
  const auto found = convex_components(bolt, {}, any);
  ASSERT_EQ(found.size(), 1);
  for (const StandIn& stand_in : found[0].stand_ins) EXPECT_LT(volume(stand_in.piece.surface), 0);
}

TEST(StandIns, of_things_alike_are_alike) {
  const Surface bolt = turned(wire(1.2, 1, 2, 8));
  Surface two = bolt;
  const glm::ivec3 way(9000, 700, -40);
  append(bolt, way, two);
  const auto found = convex_components(two, {}, any);
  ASSERT_EQ(found.size(), 2);
  ASSERT_EQ(found[0].stand_ins.size(), found[1].stand_ins.size());
  for (size_t i = 0; i < found[0].stand_ins.size(); ++i) {
    const Piece &one = found[0].stand_ins[i].piece, &other = found[1].stand_ins[i].piece;
    for (size_t k = 0; k < one.sources.size(); ++k) {
      EXPECT_EQ(one.surface.points[k] + way, other.surface.points[k]);
      EXPECT_EQ(one.sources[k] + bolt.points.size(), other.sources[k]);
    }
  }
}

TEST(StandIns, make_levels_of_whatever_has_convex_parts) {
  // A railing of rods, and something that is wavy.
  Surface railing = awkward::surface_of(awkward::wavy_sphere(16));
  for (glm::ivec3& point : railing.points) point += glm::ivec3(0, 0, 30000);
  for (int i = 0; i < 40; ++i) append(wire(10, 0.125, 2, 8), {0, 512 * i, 0}, railing);
  SimplifyLimits limits;
  limits.keep_cover = true;
  const Chain chain = simplify(railing, {}, limits);
  ASSERT_GE(chain.levels.size(), 3);
  size_t before = railing.triangles.size();
  for (const Level& level : chain.levels) {
    EXPECT_LE(level.piece.surface.triangles.size(), before);
    before = level.piece.surface.triangles.size();
    EXPECT_LE(judge::distance(railing, level.piece.surface), level.bound + 1e-6);
    for (const uint32_t source : level.piece.sources) EXPECT_LT(source, railing.points.size());
    EXPECT_NEAR(area(level.piece.surface) / area(railing), 1, 0.1);
  }
  EXPECT_LE(before, limits.triangles * 2);
}

TEST(StandIns, of_rods_are_about_as_wide_from_all_sides) {
  const Surface rod = wire(20, 0.5, 2, 16);
  const auto found = convex_components(rod, {}, any);
  ASSERT_EQ(found.size(), 1);
  const Surface& first = found[0].stand_ins.front().piece.surface;
  for (int degrees = 0; degrees < 180; degrees += 5) {
    const double angle = degrees * std::numbers::pi / 180;
    double low = 1e300, high = -1e300;
    for (const glm::ivec3& point : first.points) {
      const double along = point.y * std::cos(angle) + point.z * std::sin(angle);
      low = std::min(low, along);
      high = std::max(high, along);
    }
    EXPECT_GT(high - low, 1024 * 0.85) << degrees;
    EXPECT_LT(high - low, 1024 * 1.15) << degrees;
  }
}

TEST(Wires, that_are_thinner_than_the_bound_are_shown_with_a_smaller_error) {
  const Surface cable = turned(wire(400, 0.25, 80, 8));  // 1,024 steps a unit
  Surface bent = cable;
  for (glm::ivec3& point : bent.points) point.z += static_cast<int>(4000 * std::sin(point.x / 60000.0));
  SimplifyLimits limits;
  limits.keep_cover = true;
  limits.triangles = 8;
  size_t careful = 0;
  for (const Level& level : simplify(bent, {}, limits).levels) {
    const double distance = judge::distance(bent, level.piece.surface);
    EXPECT_LE(distance, level.bound);
    if (distance < 512) continue;
    EXPECT_LT(4 * distance, level.bound);
    ++careful;
  }
  EXPECT_GT(careful, 0);
}

}  // namespace
}  // namespace triptych
