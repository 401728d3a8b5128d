// The building's bodies are closed surfaces that face outward.
#include "samples/solids.hpp"

#include "samples/building/shell.hpp"

#include <gtest/gtest.h>
#include <map>

namespace triptych {
namespace {

/// Every edge is used as often one way as the other.
bool is_closed(const MeshPart& part) {
  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  for (size_t i = 0; i < part.indices.size(); i += 3) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = part.indices[i + k], b = part.indices[i + (k + 1) % 3];
      ++edges[{a, b}];
      --edges[{b, a}];
    }
  }
  return std::all_of(edges.begin(), edges.end(), [](const auto& edge) { return edge.second == 0; });
}

double volume(const MeshPart& part) {
  double sum = 0;
  for (size_t i = 0; i < part.indices.size(); i += 3) {
    const glm::dvec3 a(part.positions[part.indices[i]]), b(part.positions[part.indices[i + 1]]),
        c(part.positions[part.indices[i + 2]]);
    sum += glm::dot(a, glm::cross(b, c)) / 6;
  }
  return sum;
}

TEST(Solids, a_box_with_holes_is_closed_outward_and_has_the_volume_that_is_left_along_each_axis) {
  for (const int axis : {0, 1, 2}) {
    const std::vector<Rect> holes{{1, 0, 2, 2}, {2.5, 1, 3, 1.5}};
    glm::dvec3 low(0), high(4, 3, 4);
    high[axis] = 0.5;
    const MeshPart part = pierced_box(low, high, axis, holes, {1, 1, 1});
    EXPECT_TRUE(is_closed(part)) << axis;
    const double face = high[axis == 0 ? 2 : 0] * high[axis == 1 ? 2 : 1];
    EXPECT_NEAR(volume(part), (face - 2 - 0.25) * 0.5, 1e-6) << axis;
  }
}

TEST(Shell, every_body_of_a_building_is_closed_and_faces_outward) {
  const auto objects = make_shell(make_floor_plan(3, Random(5)));
  EXPECT_GT(objects.size(), 500u);
  for (const ShellObject& object : objects) {
    EXPECT_FALSE(object.places.empty()) << object.name;
    for (const MeshPart& part : object.parts) {
      EXPECT_TRUE(is_closed(part)) << object.name;
      EXPECT_GT(volume(part), 0) << object.name;
    }
  }
}

TEST(FloorPlan, rooms_of_a_floor_do_not_overlap_and_fill_the_footprint) {
  const FloorPlan plan = make_floor_plan(2, Random(9));
  for (int floor = 0; floor < 2; ++floor) {
    double area = 0;
    for (size_t i = 0; i < plan.rooms.size(); ++i) {
      if (plan.rooms[i].floor != floor) continue;
      area += plan.rooms[i].grid.area();
      for (size_t k = i + 1; k < plan.rooms.size(); ++k) {
        const bool same_floor = plan.rooms[k].floor == floor;
        EXPECT_FALSE(same_floor && plan.rooms[i].grid.overlaps(plan.rooms[k].grid.grown(-1e-9)));
      }
    }
    EXPECT_NEAR(area, measures::width * measures::depth, 1e-6);
  }
}

TEST(FloorPlan, every_room_has_a_door_or_a_passage) {
  const FloorPlan plan = make_floor_plan(7, Random(1));
  EXPECT_GE(plan.rooms.size(), 100u);
  std::vector<bool> open(plan.rooms.size());
  for (const Wall& wall : plan.walls)
    for (const Opening& opening : wall.openings)
      if (opening.kind != OpeningKind::window)
        for (const int side : {wall.low_room, wall.high_room})
          if (side >= 0) open[static_cast<size_t>(side)] = true;
  for (size_t i = 0; i < open.size(); ++i) EXPECT_TRUE(open[i]) << plan.rooms[i].name;
}

}  // namespace
}  // namespace triptych
