#include "samples/building/obstacles.hpp"

#include <algorithm>

namespace triptych {
namespace {

using namespace measures;

void add_wall(std::vector<Rect>& result, const Wall& wall) {
  std::vector<double> stops{wall.along_x ? wall.footprint.x0 : wall.footprint.z0};
  std::vector<Opening> ways;
  for (const Opening& opening : wall.openings)
    if (opening.kind != OpeningKind::window) ways.push_back(opening);
  std::sort(ways.begin(), ways.end(), [](const Opening& a, const Opening& b) { return a.from < b.from; });
  for (const Opening& way : ways) {
    const double frame = way.kind == OpeningKind::door ? door_frame : 0;
    stops.push_back(way.from + frame);
    stops.push_back(way.to - frame);
  }
  stops.push_back(wall.along_x ? wall.footprint.x1 : wall.footprint.z1);
  const Rect& f = wall.footprint;
  for (size_t i = 0; i + 1 < stops.size(); i += 2)
    result.push_back(wall.along_x ? Rect{stops[i], f.z0, stops[i + 1], f.z1}
                                  : Rect{f.x0, stops[i], f.x1, stops[i + 1]});
}

}  // namespace

std::vector<Rect> obstacles(const FloorPlan& plan, const std::vector<FurniturePlacement>& placements,
                            int floor) {
  constexpr double step_over = 0.06, head = 1.85;
  std::vector<Rect> result;
  for (const Wall& wall : plan.walls) {
    if (wall.floor != floor) continue;
    add_wall(result, wall);
    for (const Opening& opening : wall.openings)
      if (opening.kind == OpeningKind::door) result.push_back(leaf_footprint(wall, opening));
  }
  for (const Room& room : plan.rooms) {
    if (room.floor != floor) continue;
    result.insert(result.end(), room.partitions.begin(), room.partitions.end());
    for (const Rect& hole : room.voids) result.push_back(hole.grown(0.06));
    if (room.type == RoomType::stairs)
      for (const Rect& stair : stair_voids())
        if (room.grid.contains(stair)) result.push_back(stair);
  }
  for (const FurniturePlacement& placement : placements) {
    if (plan.rooms[static_cast<size_t>(placement.room)].floor != floor) continue;
    if (placement.top > step_over && placement.bottom < head) result.push_back(placement.footprint);
  }
  return result;
}

}  // namespace triptych
