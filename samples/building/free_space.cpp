#include "samples/building/free_space.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace triptych {
namespace {

using namespace measures;

constexpr int columns = static_cast<int>(width / FreeSpace::cell + 0.5);
constexpr int rows = static_cast<int>(depth / FreeSpace::cell + 0.5);
constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr float diagonal = 1.41421356f;

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

FreeSpace::FreeSpace(const std::vector<Rect>& obstacles, double clearance)
    : distance_(static_cast<size_t>(columns) * rows, infinite) {
  const auto at = [&](int column, int row) -> float& {
    return distance_[static_cast<size_t>(row * columns + column)];
  };
  for (const Rect& obstacle : obstacles) {
    const Rect grown = obstacle.grown(clearance + cell / 2);
    const auto to_cell = [](double position, int limit) {
      return std::clamp(static_cast<int>(std::floor(position / cell)), 0, limit - 1);
    };
    for (int row = to_cell(grown.z0, rows); row <= to_cell(grown.z1, rows); ++row)
      for (int column = to_cell(grown.x0, columns); column <= to_cell(grown.x1, columns); ++column)
        at(column, row) = 0;
  }
  // Two sweeps give the chamfer distance (Borgefors 1986).
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      float& here = at(column, row);
      if (column == 0 || row == 0 || column == columns - 1 || row == rows - 1) {
        here = 0;
        continue;
      }
      here = std::min({here, at(column - 1, row) + 1, at(column, row - 1) + 1,
                       at(column - 1, row - 1) + diagonal, at(column + 1, row - 1) + diagonal});
    }
  }
  for (int row = rows - 2; row > 0; --row)
    for (int column = columns - 2; column > 0; --column)
      at(column, row) = std::min({at(column, row), at(column + 1, row) + 1, at(column, row + 1) + 1,
                                  at(column + 1, row + 1) + diagonal, at(column - 1, row + 1) + diagonal});
}

int FreeSpace::index(glm::dvec2 at) const {
  const int column = static_cast<int>(std::floor(at.x / cell)),
            row = static_cast<int>(std::floor(at.y / cell));
  return column < 0 || row < 0 || column >= columns || row >= rows ? -1 : row * columns + column;
}

glm::dvec2 FreeSpace::centre(int number) const {
  return {(number % columns + 0.5) * cell, (number / columns + 0.5) * cell};
}

bool FreeSpace::is_free(glm::dvec2 at) const {
  const int number = index(at);
  return number >= 0 && distance_[static_cast<size_t>(number)] > 0;
}

bool FreeSpace::widest_place(const Room& room, glm::dvec2& place) const {
  float best = 0;
  for (double z = room.area.z0; z < room.area.z1; z += cell) {
    for (double x = room.area.x0; x < room.area.x1; x += cell) {
      const int number = index({x, z});
      if (number < 0 || distance_[static_cast<size_t>(number)] <= best) continue;
      best = distance_[static_cast<size_t>(number)];
      place = centre(number);
    }
  }
  return best > 0;
}

FreeSpace::Ways FreeSpace::ways_from(glm::dvec2 start, double reach, const Rect& avoided) const {
  Ways ways{std::vector<float>(distance_.size(), infinite), std::vector<int32_t>(distance_.size(), -1)};
  using Entry = std::pair<float, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const int first = index(start);
  if (first < 0) return ways;
  ways.length[static_cast<size_t>(first)] = 0;
  open.emplace(0.0f, first);
  const std::array<std::pair<int, float>, 8> steps{{{1, 1.0f},
                                                    {-1, 1.0f},
                                                    {columns, 1.0f},
                                                    {-columns, 1.0f},
                                                    {columns + 1, diagonal},
                                                    {columns - 1, diagonal},
                                                    {-columns + 1, diagonal},
                                                    {-columns - 1, diagonal}}};
  while (!open.empty()) {
    const auto [length, here] = open.top();
    open.pop();
    if (length > ways.length[static_cast<size_t>(here)]) continue;
    if (length * cell > reach) break;
    for (const auto& [offset, step] : steps) {
      const int next = here + offset;  // the border is never free, so this stays inside
      if (distance_[static_cast<size_t>(next)] <= 0) continue;
      const glm::dvec2 at = centre(next);
      if (avoided.overlaps({at.x, at.y, at.x, at.y})) continue;
      // People keep away from furniture where they can.
      const float near = std::max(0.0f, 8.0f - distance_[static_cast<size_t>(next)]) * 0.1f;
      const float candidate = length + step * (1 + near);
      if (candidate >= ways.length[static_cast<size_t>(next)]) continue;
      ways.length[static_cast<size_t>(next)] = candidate;
      ways.previous[static_cast<size_t>(next)] = here;
      open.emplace(candidate, next);
    }
  }
  return ways;
}

double FreeSpace::length_to(const Ways& ways, glm::dvec2 end) const {
  const int number = index(end);
  return number < 0 ? infinite : ways.length[static_cast<size_t>(number)] * cell;
}

std::vector<glm::dvec2> FreeSpace::way_to(const Ways& ways, glm::dvec2 end) const {
  std::vector<glm::dvec2> way;
  for (int number = index(end); number >= 0; number = ways.previous[static_cast<size_t>(number)])
    way.push_back(centre(number));
  std::reverse(way.begin(), way.end());
  return way;
}

}  // namespace triptych
