#include "simplify/star.hpp"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <random>
#include <set>
#include <utility>

namespace triptych {
namespace {

/// Around point 0: triangles (0, from, to) in the plane or above it.
Surface star_of(const std::vector<std::array<uint32_t, 2>>& edges) {
  Surface surface;
  surface.points = {{0, 0, 0},     {100, 0, 3},   {70, 70, 11}, {0, 100, 7},  {-70, 70, 2},
                    {-100, 0, 19}, {-70, -70, 5}, {0, -100, 1}, {70, -70, 23}};
  for (const auto& [from, to] : edges) surface.triangles.push_back({{0, from, to}, 0});
  return surface;
}

/// For each fan whether it is closed, and its triangles.
using Fans = std::set<std::pair<bool, std::set<uint32_t>>>;

Fans fans_of(const Surface& surface) {
  ShrinkingMesh mesh(surface);
  Star star;
  EXPECT_TRUE(star.read(mesh, 0));
  Fans fans;
  for (const Star::Fan& fan : star.fans()) {
    std::set<uint32_t> triangles;
    for (size_t i = fan.begin; i < fan.end; ++i) {
      triangles.insert(star.spokes()[i].triangle);
      const bool last = i + 1 == fan.end;
      if (!last || fan.closed) {
        EXPECT_EQ(star.spokes()[i].to, star.spokes()[last ? fan.begin : i + 1].from);
      }
    }
    fans.insert({fan.closed, triangles});
  }
  return fans;
}

TEST(Star, open_and_closed_fans_are_found_in_any_order_of_the_triangles) {
  std::mt19937 random(3);
  std::vector<std::array<uint32_t, 2>> ring = {{1, 2}, {2, 3}, {3, 4}, {4, 5}, {5, 6}, {6, 7}, {7, 8}};
  for (int i = 0; i < 50; ++i) {
    std::shuffle(ring.begin(), ring.end(), random);
    EXPECT_EQ(fans_of(star_of(ring)), (Fans{{false, {0, 1, 2, 3, 4, 5, 6}}}));
    auto closed = ring;
    closed.push_back({8, 1});
    EXPECT_EQ(fans_of(star_of(closed)), (Fans{{true, {0, 1, 2, 3, 4, 5, 6, 7}}}));
  }
}

/// Stars that hang together in one fan, all turned the same way, are ordered by a shorter way than others;
/// one triangle turned round takes the longer one.
TEST(Star, is_parted_in_the_same_fans_whichever_way_its_triangles_are_turned) {
  std::mt19937 random(4);
  int single = 0, several = 0;
  for (int i = 0; i < 20000; ++i) {
    std::set<std::array<uint32_t, 2>> edges;
    std::array<int, 9> uses{};
    for (size_t wanted = 2 + random() % 6; wanted > 0; --wanted) {
      const auto from = static_cast<uint32_t>(1 + random() % 8), to = static_cast<uint32_t>(1 + random() % 8);
      // More than two at an edge are a matter of angles, and sheets that cover each other of their turn.
      if (from == to || uses[from] == 2 || uses[to] == 2 || edges.contains({to, from})) continue;
      if (edges.insert({from, to}).second) ++uses[from], ++uses[to];
    }
    if (edges.size() < 2) continue;
    std::vector<std::array<uint32_t, 2>> listed(edges.begin(), edges.end());
    std::shuffle(listed.begin(), listed.end(), random);
    const auto fans = fans_of(star_of(listed));
    (fans.size() == 1 ? single : several) += 1;
    std::swap(listed.back()[0], listed.back()[1]);
    EXPECT_EQ(fans_of(star_of(listed)), fans);
  }
  EXPECT_GT(single, 1000);
  EXPECT_GT(several, 1000);
}

TEST(Star, that_goes_through_a_corner_twice_is_no_single_fan_in_any_order) {
  std::mt19937 random(5);
  std::vector<std::array<uint32_t, 2>> eight = {{1, 4}, {4, 7}, {7, 1}, {1, 2}, {2, 6}, {6, 1}};
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ(fans_of(star_of(eight)).size(), 2u) << i;
    std::shuffle(eight.begin(), eight.end(), random);
  }
}

TEST(Star, where_three_meet_at_an_edge_is_no_single_fan) {
  // Corner 2 has three triangles; the third is chained with neither.
  EXPECT_EQ(fans_of(star_of({{1, 2}, {2, 3}, {7, 2}})).size(), 2u);
  EXPECT_EQ(fans_of(star_of({{7, 2}, {1, 2}, {2, 3}})).size(), 2u);
  // Two that cover each other are no fan of two.
  EXPECT_EQ(fans_of(star_of({{1, 2}, {2, 1}})).size(), 2u);
}

}  // namespace
}  // namespace triptych
