// Cells along walls, and portals where those are open.
#include "cells/make_cells.hpp"

#include "cells/split_space.hpp"
#include "tests/support/scenes.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <set>

namespace triptych {
namespace {

uint32_t cell_at(const CellGraph& graph, const glm::dvec3& point) {
  std::vector<uint32_t> open;
  uint32_t found = 0;
  graph.any_touched({point, point}, open, [&](uint32_t cell) {
    found = cell;
    return true;
  });
  return found;
}

/// Two rooms of 4 by 3 by 3, side by side along x, in a plane at x = 4 that has a door.
Walls two_rooms() {
  Walls walls;
  walls.tolerance = 1e-6;
  const auto rectangle = [](const glm::dvec2& lo, const glm::dvec2& hi) {
    return std::vector<WallTriangle>{{{lo, {hi.x, lo.y}, hi}}, {{lo, hi, {lo.x, hi.y}}}};
  };
  WallPlane plane{0, 4, rectangle({0, 0}, {1, 3}), 0};
  for (const auto& part : {rectangle({2, 0}, {3, 3}), rectangle({1, 2}, {2, 3})})
    plane.triangles.insert(plane.triangles.end(), part.begin(), part.end());
  for (const double x : {0.0, 8.0}) walls.planes.push_back({0, x, rectangle({0, 0}, {3, 3}), 9});
  walls.planes.push_back(plane);
  for (const double y : {0.0, 3.0}) walls.planes.push_back({1, y, rectangle({0, 0}, {3, 8}), 24});
  for (const double z : {0.0, 3.0}) walls.planes.push_back({2, z, rectangle({0, 0}, {8, 3}), 24});
  std::stable_sort(walls.planes.begin(), walls.planes.end(), [](const WallPlane& a, const WallPlane& b) {
    return std::pair(a.axis, a.at) < std::pair(b.axis, b.at);
  });
  return walls;
}

TEST(MakeCells, rooms_are_cells_and_the_door_between_them_is_the_only_way_out) {
  const CellGraph graph = make_cells(two_rooms(), {{0, 0, 0}, {8, 3, 3}});
  const uint32_t left = cell_at(graph, {2, 1.5, 1.5}), right = cell_at(graph, {6, 1.5, 1.5});
  ASSERT_NE(left, right);
  for (const auto& [from, to, up] : {std::tuple(left, right, true), std::tuple(right, left, false)}) {
    const SpaceCell& cell = graph.cells[from];
    ASSERT_EQ(cell.portal_count, 1u);
    const Portal& portal = graph.portals[cell.first_portal];
    EXPECT_EQ(portal.to, to);
    EXPECT_EQ(portal.axis, 0);
    EXPECT_EQ(portal.up, up);
    EXPECT_LT(glm::distance(portal.box.lo, glm::dvec3(4, 1, 0)), 1e-9);
    EXPECT_LT(glm::distance(portal.box.hi, glm::dvec3(4, 2, 2)), 1e-9);
  }
}

TEST(MakeCells, cells_fill_the_box_and_portals_come_in_pairs) {
  const CellGraph graph = make_cells(scenes::pack("room"));
  ASSERT_GT(graph.cells.size(), 4u);
  EXPECT_TRUE(std::is_sorted(graph.cells.begin(), graph.cells.end(),
                             [](const auto& a, const auto& b) { return a.first_portal < b.first_portal; }));
  double volume = 0;
  std::multiset<std::tuple<uint32_t, uint32_t, double, double, double>> ways;
  for (uint32_t id = 0; id < graph.cells.size(); ++id) {
    const SpaceCell& cell = graph.cells[id];
    const glm::dvec3 size = cell.box.hi - cell.box.lo;
    volume += size.x * size.y * size.z;
    for (uint32_t i = cell.first_portal; i < cell.first_portal + cell.portal_count; ++i) {
      const Portal& portal = graph.portals[i];
      const double at = portal.box.lo[portal.axis];
      EXPECT_EQ(at, portal.box.hi[portal.axis]);
      EXPECT_EQ(at, portal.up ? cell.box.hi[portal.axis] : cell.box.lo[portal.axis]);
      const Box& other = graph.cells[portal.to].box;
      EXPECT_EQ(at, portal.up ? other.lo[portal.axis] : other.hi[portal.axis]);
      const glm::dvec3 middle = center(portal.box);
      ways.insert({id, portal.to, middle.x, middle.y, middle.z});
    }
  }
  const glm::dvec3 whole = graph.box.hi - graph.box.lo;
  EXPECT_NEAR(volume, whole.x * whole.y * whole.z, 1e-6 * volume);
  for (const auto& [from, to, x, y, z] : ways) EXPECT_EQ(ways.count({to, from, x, y, z}), 1u);
}

TEST(MakeCells, are_the_same_each_time_and_none_without_walls) {
  const CellGraph one = make_cells(scenes::pack("room")), other = make_cells(scenes::pack("room"));
  ASSERT_EQ(one.portals.size(), other.portals.size());
  for (size_t i = 0; i < one.portals.size(); ++i) {
    EXPECT_EQ(one.portals[i].to, other.portals[i].to);
    EXPECT_EQ(one.portals[i].box, other.portals[i].box);
  }
  const CellGraph none = make_cells(scenes::pack("triangle"));
  EXPECT_LE(none.cells.size(), 2u);
}

TEST(FindWalls, takes_no_glass_for_a_wall_and_nothing_small) {
  const Walls room = find_walls(scenes::pack("room"));
  EXPECT_GT(room.planes.size(), 4u);
  for (const WallPlane& plane : room.planes) {
    for (const WallTriangle& triangle : plane.triangles) {
      const glm::dvec2 a = triangle.corners[1] - triangle.corners[0],
                       b = triangle.corners[2] - triangle.corners[0];
      EXPECT_GT(a.x * b.y - a.y * b.x, 0) << "they go round counter-clockwise";
    }
  }
  EXPECT_EQ(walls_at(room, 0, 12345.0), nullptr);
}

}  // namespace
}  // namespace triptych
