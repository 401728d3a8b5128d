#include "samples/free_space.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>

namespace triptych {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr float diagonal = 1.41421356f;

}  // namespace

FreeSpace::FreeSpace(const Rect& area, const std::vector<Rect>& obstacles, double clearance)
    : corner_(area.x0, area.z0),
      columns_(static_cast<int>(area.width() / cell + 0.5)),
      rows_(static_cast<int>(area.depth() / cell + 0.5)),
      distance_(static_cast<size_t>(columns_) * static_cast<size_t>(rows_), infinite) {
  const auto at = [&](int column, int row) -> float& {
    return distance_[static_cast<size_t>(row * columns_ + column)];
  };
  for (const Rect& obstacle : obstacles) {
    const Rect grown = obstacle.grown(clearance + cell / 2);
    // What lies outside marks cells at the border, which are not free anyway.
    const auto to_cell = [](double position, int limit) {
      return std::clamp(static_cast<int>(std::floor(position / cell)), 0, limit - 1);
    };
    for (int row = to_cell(grown.z0 - corner_.y, rows_); row <= to_cell(grown.z1 - corner_.y, rows_); ++row)
      for (int column = to_cell(grown.x0 - corner_.x, columns_);
           column <= to_cell(grown.x1 - corner_.x, columns_); ++column)
        at(column, row) = 0;
  }
  // Two sweeps give the chamfer distance (Borgefors 1986).
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      float& here = at(column, row);
      if (column == 0 || row == 0 || column == columns_ - 1 || row == rows_ - 1) {
        here = 0;
        continue;
      }
      here = std::min({here, at(column - 1, row) + 1, at(column, row - 1) + 1,
                       at(column - 1, row - 1) + diagonal, at(column + 1, row - 1) + diagonal});
    }
  }
  for (int row = rows_ - 2; row > 0; --row)
    for (int column = columns_ - 2; column > 0; --column)
      at(column, row) = std::min({at(column, row), at(column + 1, row) + 1, at(column, row + 1) + 1,
                                  at(column + 1, row + 1) + diagonal, at(column - 1, row + 1) + diagonal});
}

int FreeSpace::index(glm::dvec2 at) const {
  const int column = static_cast<int>(std::floor((at.x - corner_.x) / cell)),
            row = static_cast<int>(std::floor((at.y - corner_.y) / cell));
  return column < 0 || row < 0 || column >= columns_ || row >= rows_ ? -1 : row * columns_ + column;
}

glm::dvec2 FreeSpace::centre(int number) const {
  return corner_ + glm::dvec2((number % columns_ + 0.5) * cell, (number / columns_ + 0.5) * cell);
}

bool FreeSpace::is_free(glm::dvec2 at) const {
  const int number = index(at);
  return number >= 0 && distance_[static_cast<size_t>(number)] > 0;
}

bool FreeSpace::widest_place(const Rect& room, glm::dvec2& place) const {
  float best = 0;
  for (double z = room.z0; z < room.z1; z += cell) {
    for (double x = room.x0; x < room.x1; x += cell) {
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
                                                    {columns_, 1.0f},
                                                    {-columns_, 1.0f},
                                                    {columns_ + 1, diagonal},
                                                    {columns_ - 1, diagonal},
                                                    {-columns_ + 1, diagonal},
                                                    {-columns_ - 1, diagonal}}};
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
