// What is proven to be outward: solids, and nothing else, however it is put together.
#include "preprocess/outward.hpp"

#include "tests/support/scenes.hpp"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <tuple>

namespace triptych {
namespace {

using scenes::Random;

struct Soup {
  std::vector<glm::ivec3> points;
  std::vector<uint32_t> indices;

  void add(const glm::ivec3& a, const glm::ivec3& b, const glm::ivec3& c) {
    for (const glm::ivec3& point : {a, b, c}) {
      indices.push_back(static_cast<uint32_t>(points.size()));
      points.push_back(point);
    }
  }
  void quad(const glm::ivec3& a, const glm::ivec3& b, const glm::ivec3& c, const glm::ivec3& d) {
    add(a, b, c);
    add(a, c, d);
  }
  /// The sides of a cell, outwards, without those that `skip` says to leave out.
  template <typename Skip>
  void cell(const glm::ivec3& lo, const glm::ivec3& hi, const Skip& skip) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const bool high : {false, true}) {
        if (skip(axis, high)) continue;
        std::array<glm::ivec3, 4> corners;
        for (size_t k = 0; k < 4; ++k) {
          const bool u = k == 1 || k == 2, v = k >= 2;
          glm::ivec3& corner = corners[high ? k : 3 - k];
          corner[axis] = high ? hi[axis] : lo[axis];
          corner[(axis + 1) % 3] = u ? hi[(axis + 1) % 3] : lo[(axis + 1) % 3];
          corner[(axis + 2) % 3] = v ? hi[(axis + 2) % 3] : lo[(axis + 2) % 3];
        }
        quad(corners[0], corners[1], corners[2], corners[3]);
      }
    }
  }
  void box(const glm::ivec3& lo, const glm::ivec3& hi) {
    cell(lo, hi, [](int, bool) { return false; });
  }
  void turn_round() {
    for (size_t i = 0; i < indices.size(); i += 3) std::swap(indices[i + 1], indices[i + 2]);
  }
  size_t outward() const {
    const std::vector<bool> found = outward_triangles(points, indices);
    return static_cast<size_t>(std::count(found.begin(), found.end(), true));
  }
  size_t count() const { return indices.size() / 3; }
};

/// The outlines of the plane, extruded: corners counter-clockwise as seen from above.
Soup prism(const std::vector<glm::ivec2>& outline, const std::vector<std::array<size_t, 3>>& cap) {
  Soup soup;
  const auto at = [&](size_t i, int z) { return glm::ivec3(outline[i % outline.size()], z); };
  for (size_t i = 0; i < outline.size(); ++i) soup.quad(at(i, 0), at(i + 1, 0), at(i + 1, 9), at(i, 9));
  for (const auto& [a, b, c] : cap) {
    soup.add(at(a, 9), at(b, 9), at(c, 9));
    soup.add(at(a, 0), at(c, 0), at(b, 0));
  }
  return soup;
}

TEST(Outward, a_box_is_and_one_inside_out_or_open_is_not) {
  Soup soup;
  soup.box({-3, 2, 5}, {4, 9, 6});
  EXPECT_EQ(soup.outward(), 12u);
  soup.turn_round();
  EXPECT_EQ(soup.outward(), 0u);
  Soup open;
  open.cell({0, 0, 0}, {1, 1, 1}, [](int axis, bool high) { return axis == 1 && high; });
  EXPECT_EQ(open.outward(), 0u);
  open.box({5, 5, 5}, {6, 6, 6});
  EXPECT_EQ(open.outward(), 12u) << "beside an open one";
}

TEST(Outward, one_side_turned_round_spoils_a_box) {
  Soup soup;
  soup.box({0, 0, 0}, {2, 2, 2});
  std::swap(soup.indices[4], soup.indices[5]);
  EXPECT_EQ(soup.outward(), 0u);
}

TEST(Outward, what_no_single_point_sees_from_within_is_found_all_the_same) {
  // A U, whose arms see nothing of each other.
  const Soup u = prism({{0, 0}, {9, 0}, {9, 9}, {7, 9}, {7, 2}, {2, 2}, {2, 9}, {0, 9}},
                       {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {0, 4, 5}, {0, 5, 6}, {0, 6, 7}});
  EXPECT_EQ(u.outward(), u.count());
}

TEST(Outward, a_surface_that_crosses_itself_is_not_though_it_is_closed) {
  // The last corner of the U reaches through its other arm.
  const Soup crossed = prism({{0, 0}, {9, 0}, {9, 9}, {-3, 6}, {7, 2}, {2, 2}, {2, 9}, {0, 9}},
                             {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {0, 4, 5}, {0, 5, 6}, {0, 6, 7}});
  EXPECT_EQ(crossed.outward(), 0u);
}

TEST(Outward, boxes_that_stand_in_each_other_are_each_for_itself) {
  Soup soup;
  soup.box({0, 0, 0}, {4, 4, 4});
  soup.box({2, 2, 2}, {7, 7, 7});
  soup.box({4, 4, 4}, {5, 5, 5});  // at a corner of the first one
  EXPECT_EQ(soup.outward(), 36u);
}

TEST(Outward, of_a_box_with_a_cavity_it_is_the_outside) {
  Soup cavity;
  cavity.box({100, 100, 100}, {300, 300, 300});
  cavity.turn_round();
  Soup hollow;
  hollow.box({0, 0, 0}, {1000, 1000, 1000});
  hollow.box({2000, 0, 0}, {3000, 1000, 1000});
  EXPECT_EQ(hollow.outward(), 24u);
  for (size_t i = 0; i < cavity.points.size(); i += 3)
    hollow.add(cavity.points[cavity.indices[i]], cavity.points[cavity.indices[i + 1]],
               cavity.points[cavity.indices[i + 2]]);
  EXPECT_EQ(hollow.outward(), 24u);
}

TEST(Outward, solids_that_touch_are_each_for_itself) {
  Soup edge;
  edge.box({0, 0, 0}, {1, 1, 1});
  edge.box({1, 1, 0}, {2, 2, 1});
  EXPECT_EQ(edge.outward(), 24u);
  Soup layers;
  for (int i = 0; i < 4; ++i) layers.box({0, 0, 3 * i}, {9, 7, 3 * i + 3});
  layers.box({0, 7, 3}, {9, 8, 6});  // before one of them
  EXPECT_EQ(layers.outward(), 60u);
  Soup leaning;  // prisms around an edge, whose faces lie in no plane of the lattice
  const std::array<glm::ivec3, 5> around{{{7, 1, 0}, {2, 9, 1}, {-5, 6, 3}, {-4, -7, 2}, {6, -5, -1}}};
  for (size_t i = 0; i < around.size(); ++i) {
    const glm::ivec3 a = around[i], b = around[(i + 1) % around.size()], up{1, -1, 20}, o{0, 0, 0};
    leaning.add(o, b, a);
    leaning.add(o + up, a + up, b + up);
    leaning.quad(o, a, a + up, o + up);
    leaning.quad(a, b, b + up, a + up);
    leaning.quad(b, o, o + up, b + up);
  }
  EXPECT_EQ(leaning.outward(), 40u);
  leaning.turn_round();
  EXPECT_EQ(leaning.outward(), 0u);
}

TEST(Outward, a_solid_that_touches_itself_in_an_edge_is_one) {
  // A ring of cells that closes at an edge.
  Soup ring;
  const std::set<std::pair<int, int>> cells = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 2}, {0, 2}, {0, 1}};
  for (const auto& [x, y] : cells) {
    ring.cell({x, y, 0}, {x + 1, y + 1, 1}, [&, x = x, y = y](int axis, bool high) {
      const int step = high ? 1 : -1;
      return axis < 2 && cells.contains({x + (axis == 0 ? step : 0), y + (axis == 1 ? step : 0)});
    });
  }
  EXPECT_EQ(ring.outward(), ring.count());
}

TEST(Outward, one_side_too_many_and_doubled_surfaces_are_left_alone) {
  Soup wing;
  wing.box({0, 0, 0}, {1, 1, 1});
  wing.box({1, 1, 0}, {2, 2, 1});
  wing.quad({1, 1, 0}, {2, 0, 0}, {2, 0, 1}, {1, 1, 1});
  EXPECT_EQ(wing.outward(), 24u) << "what is in no wedge leaves solids as they are";
  Soup twice;
  twice.box({0, 0, 0}, {1, 1, 1});
  twice.box({0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(twice.outward(), 0u);
}

TEST(Outward, a_flat_closed_surface_is_not) {
  Soup soup;
  soup.quad({0, 0, 0}, {5, 0, 0}, {5, 5, 0}, {0, 5, 0});
  soup.quad({0, 5, 0}, {5, 5, 0}, {5, 0, 0}, {0, 0, 0});
  EXPECT_EQ(soup.outward(), 0u);
}

TEST(Outward, triangles_of_two_corners_change_nothing) {
  Soup soup;
  soup.box({0, 0, 0}, {1, 1, 1});
  soup.add({0, 0, 0}, {0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(soup.outward(), 12u);
}

TEST(Outward, the_ends_of_the_lattice_are_no_trouble) {
  Soup soup;
  soup.box(glm::ivec3(-(1 << 29)), glm::ivec3(1 << 29));
  soup.box({(1 << 29) - 2, -(1 << 29), (1 << 29) - 2}, {(1 << 29) - 1, 1 << 29, (1 << 29) - 1});
  EXPECT_EQ(soup.outward(), 24u);
}

/// How often a ray along x enters what the triangles enclose, less how often it leaves. From points with
/// coordinates between those of corners.
int winding(const Soup& soup, std::span<const uint32_t> triangles, const glm::dvec3& from) {
  int sum = 0;
  for (const uint32_t triangle : triangles) {
    std::array<glm::dvec3, 3> p;
    for (size_t k = 0; k < 3; ++k) p[k] = glm::dvec3(soup.points[soup.indices[3 * triangle + k]]) - from;
    const auto side = [&](size_t a, size_t b) { return p[a].y * p[b].z - p[b].y * p[a].z; };
    const double ab = side(0, 1), bc = side(1, 2), ca = side(2, 0);
    if (!((ab > 0 && bc > 0 && ca > 0) || (ab < 0 && bc < 0 && ca < 0))) continue;
    const double x = (p[0].x * bc + p[1].x * ca + p[2].x * ab) / (ab + bc + ca);
    if (x > 0) sum += ab > 0 ? 1 : -1;
  }
  return sum;
}

TEST(Outward, of_random_heaps_of_cells_only_what_is_seen_from_outside_is_proven) {
  size_t proven = 0, left = 0;
  for (uint32_t seed = 1; seed <= 400; ++seed) {
    Random random(seed);
    constexpr int side = 4;
    std::set<std::tuple<int, int, int>> filled;
    const double share = random.number(0.1, 0.7);
    for (int i = 0; i < side * side * side; ++i) {
      if (random.number(0, 1) < share) filled.insert({i % side, i / side % side, i / side / side});
    }
    // Corners are moved about, so that sides lean, and some heaps cross themselves.
    std::map<std::tuple<int, int, int>, glm::ivec3> moved;
    const double reach = seed % 3 == 0 ? 90 : 40;
    const auto place = [&](const glm::ivec3& corner) {
      const auto [found, fresh] = moved.try_emplace(std::tuple(corner.x, corner.y, corner.z));
      if (fresh) found->second = corner * 100 + glm::ivec3(reach * random.vector(-1, 1));
      return found->second;
    };
    Soup soup;
    for (const auto& [x, y, z] : filled) {
      soup.cell({x, y, z}, {x + 1, y + 1, z + 1}, [&](int axis, bool high) {
        std::array<int, 3> beside{x, y, z};
        beside[static_cast<size_t>(axis)] += high ? 1 : -1;
        return filled.contains({beside[0], beside[1], beside[2]});
      });
    }
    for (glm::ivec3& point : soup.points) point = place(point);
    const std::vector<bool> outward = outward_triangles(soup.points, soup.indices);
    std::vector<uint32_t> said;
    for (uint32_t i = 0; i < outward.size(); ++i) {
      if (outward[i]) said.push_back(i);
    }
    proven += said.size();
    left += outward.size() - said.size();
    for (int i = 0; i < 300; ++i) {
      const glm::dvec3 at = glm::dvec3(side * 50) + side * 70.0 * random.vector(-1, 1);
      const int times = winding(soup, said, at + glm::dvec3(0.25, 0.31, 0.37));
      ASSERT_TRUE(times >= 0) << seed;
    }
  }
  EXPECT_GT(proven, 2000u);
  EXPECT_GT(left, 2000u);
}

}  // namespace
}  // namespace triptych
