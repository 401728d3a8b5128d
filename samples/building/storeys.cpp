#include "samples/building/storeys.hpp"

#include <algorithm>

namespace triptych {

namespace {

/// For each room of the plan its number among those of its storey, and how many there are on each storey.
struct RoomNumbers {
  RoomNumbers(const FloorPlan& plan) : of_storey(static_cast<size_t>(plan.floors), 0) {
    for (const Room& room : plan.rooms) within.push_back(of_storey[static_cast<size_t>(room.floor)]++);
  }
  std::vector<int> within, of_storey;
};

}  // namespace

std::vector<int> repeated_storeys(int floors, int different) {
  std::vector<int> storeys;
  const int between = std::min(different, floors - 2);
  for (int floor = 0; floor < floors; ++floor) {
    const bool highest = floor + 1 == floors;
    storeys.push_back(floor == 0 ? 0 : highest ? between + 1 : 1 + (floor - 1) % between);
  }
  return storeys;
}

int different_storeys(std::span<const int> storeys) {
  return *std::max_element(storeys.begin(), storeys.end()) + 1;
}

FloorPlan repeat_plan(const FloorPlan& plan, std::span<const int> storeys) {
  const RoomNumbers numbers(plan);
  FloorPlan tower;
  tower.floors = static_cast<int>(storeys.size());
  for (int floor = 0; floor < tower.floors; ++floor) {
    const int storey = storeys[static_cast<size_t>(floor)];
    const auto first = static_cast<int>(tower.rooms.size());
    for (Room room : plan.rooms) {
      if (room.floor != storey) continue;
      room.floor = floor;
      tower.rooms.push_back(std::move(room));
    }
    const auto renumber = [&](int& room) {
      if (room >= 0) room = first + numbers.within[static_cast<size_t>(room)];
    };
    for (Wall wall : plan.walls) {
      if (wall.floor != storey) continue;
      wall.floor = floor;
      renumber(wall.low_room);
      renumber(wall.high_room);
      tower.walls.push_back(std::move(wall));
    }
  }
  return tower;
}

std::vector<FurniturePlacement> repeat_placements(const FloorPlan& plan,
                                                  const std::vector<FurniturePlacement>& placements,
                                                  std::span<const int> storeys) {
  const RoomNumbers numbers(plan);
  std::vector<FurniturePlacement> tower;
  int first = 0;
  for (size_t floor = 0; floor < storeys.size(); ++floor) {
    const int storey = storeys[floor];
    for (FurniturePlacement placement : placements) {
      const auto room = static_cast<size_t>(placement.room);
      if (plan.rooms[room].floor != storey) continue;
      placement.position.y += floor_level(static_cast<int>(floor)) - floor_level(storey);
      placement.room = first + numbers.within[room];
      tower.push_back(placement);
    }
    first += numbers.of_storey[static_cast<size_t>(storey)];
  }
  return tower;
}

}  // namespace triptych
