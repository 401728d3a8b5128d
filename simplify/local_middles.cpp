#include "simplify/local_middles.hpp"

#include <cmath>

namespace triptych {

namespace {

/// So many points of a cell are enough.
constexpr size_t enough = 32;
/// Of the thickness; a section has two thicknesses from side to side.
constexpr double reach_factor = 3;
/// Of what has no more points than this, and is much longer than wide, ends are two points: no further apart
/// than this, of the radius.
constexpr size_t few = 64;
constexpr double end_width = 0.25;

}  // namespace

double LocalMiddles::reach(uint32_t component) const {
  const Cover& cover = components_.covers[component];
  return reach_factor * cover.thickness * (1 + cover.flatness);
}

LocalMiddles::CellKey LocalMiddles::cell_of(uint32_t component, const glm::dvec3& point) const {
  const glm::ivec3 cell(glm::floor((point - components_.covers[component].middle) / reach(component)));
  return {component, static_cast<uint32_t>(cell.x), static_cast<uint32_t>(cell.y),
          static_cast<uint32_t>(cell.z)};
}

void LocalMiddles::fill_cells(uint32_t component) {
  if (points_.empty()) {
    points_.resize(components_.covers.size());
    for (uint32_t i = 0; i < surface_.points.size(); ++i) points_[components_.component_of[i]].push_back(i);
  }
  for (const uint32_t point : points_[component])
    cells_[cell_of(component, surface_.points[point])].push_back(point);
  has_cells_[component] = 1;
}

glm::dvec3 LocalMiddles::around(uint32_t point) {
  const uint32_t component = components_.component_of[point];
  if (!has_cells_[component]) fill_cells(component);
  const glm::dvec3 place(surface_.points[point]);
  const CellKey own = cell_of(component, place);
  const double furthest = reach(component);
  glm::dvec3 sum(0);
  double count = 0;
  for (uint32_t k = 0; k < 27; ++k) {
    const auto found =
        cells_.find(CellKey{component, own[1] + k % 3 - 1, own[2] + k / 3 % 3 - 1, own[3] + k / 9 - 1});
    if (found == cells_.end()) continue;
    const std::vector<uint32_t>& points = found->second;
    const size_t step = points.size() / enough + 1;
    for (size_t i = 0; i < points.size(); i += step) {
      const glm::dvec3 way = glm::dvec3(surface_.points[points[i]]) - place;
      if (glm::length(way) > furthest) continue;
      sum += way;
      ++count;
    }
  }
  return count > 1 ? place + sum / count : middle_of_two(component, place);
}

/// Between a point that has none around it and the nearest one, if that is much nearer than the thing is
/// long: the end of something that has few points left.
glm::dvec3 LocalMiddles::middle_of_two(uint32_t component, const glm::dvec3& place) const {
  const std::vector<uint32_t>& points = points_[component];
  if (points.size() > few) return place;
  double least = end_width * components_.covers[component].radius;
  glm::dvec3 nearest = place;
  for (const uint32_t other : points) {
    const glm::dvec3 there(surface_.points[other]);
    const double distance = glm::distance(there, place);
    if (distance == 0 || distance >= least) continue;
    least = distance;
    nearest = there;
  }
  return (place + nearest) / 2.0;
}

}  // namespace triptych
