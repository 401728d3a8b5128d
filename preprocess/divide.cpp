#include "preprocess/divide.hpp"

#include <algorithm>

namespace triptych {

namespace {

/// Which closed surfaces the groups of triangles have alone, and which they share.
class SharedBodies {
 public:
  SharedBodies(const Surface& surface, const ClosedTriangles& closed,
               std::span<const std::vector<uint32_t>> groups)
      : surface_(surface), closed_(closed), numbers_(closed.bodies, no_id) {
    std::vector<uint32_t> group_of(closed_.bodies, no_id);
    for (uint32_t group = 0; group < groups.size(); ++group) {
      for (const uint32_t triangle : groups[group]) {
        const uint32_t body = closed_.body_of[triangle];
        if (body == no_id) continue;
        if (group_of[body] == no_id) group_of[body] = group;
        if (group_of[body] != group && numbers_[body] == no_id) numbers_[body] = count++;
      }
    }
  }

  /// Puts what is closed first. Returns the group's runs.
  std::vector<PartRun> sort(std::vector<uint32_t>& group) const {
    const auto place = [&](uint32_t triangle) {
      const uint32_t body = closed_.body_of[triangle];
      if (body == no_id) return uint64_t{no_id} + 1;
      return numbers_[body] == no_id ? 0 : uint64_t{numbers_[body]} + 1;
    };
    std::ranges::stable_sort(group, {}, place);
    std::vector<PartRun> runs;
    for (const uint32_t triangle : group) {
      if (closed_.body_of[triangle] == no_id) break;
      const uint32_t body = numbers_[closed_.body_of[triangle]];
      if (runs.empty() || runs.back().body != body) runs.push_back({0, body, {}});
      ++runs.back().triangles;
      for (const uint32_t vertex : surface_.triangles[triangle].vertices)
        runs.back().box.extend(surface_.points[vertex]);
    }
    return runs;
  }

  uint32_t count = 0;  ///< of those that are shared

 private:
  const Surface& surface_;
  const ClosedTriangles& closed_;
  std::vector<uint32_t> numbers_;  ///< of shared ones
};

}  // namespace

Division divide(const Surface& surface, const PartitionLimits& limits, const ClosedTriangles& closed,
                std::span<const SharedPoint> shared, uint32_t first_own) {
  Division division;
  division.first_own = first_own;
  auto groups = partition_triangles(surface, limits);
  if (groups.empty()) return division;
  const SharedBodies bodies(surface, closed, groups);
  division.bodies = bodies.count;
  for (auto& group : groups) division.runs.push_back(bodies.sort(group));

  constexpr uint32_t none = 0xffffffffu;
  std::vector<uint32_t> numbers(surface.points.size(), none);
  if (!shared.empty()) {
    for (size_t i = 0; i < numbers.size(); ++i) {
      numbers[i] = number_in(shared, surface.points[i]).value_or(none);
    }
  }
  if (groups.size() > 1) {
    std::vector<uint32_t> user(surface.points.size(), none);  // the first group that has the point
    for (uint32_t group = 0; group < groups.size(); ++group) {
      for (const uint32_t index : groups[group]) {
        for (const uint32_t vertex : surface.triangles[index].vertices) {
          if (user[vertex] == none) user[vertex] = group;
          if (user[vertex] != group && numbers[vertex] == none)
            numbers[vertex] = first_own + division.own_borders++;
        }
      }
    }
  }
  std::vector<Triangle> triangles;
  std::vector<SurfaceCorners> colors;
  for (const auto& group : groups) {
    triangles.clear();
    colors.clear();
    for (const uint32_t index : group) {
      triangles.push_back(surface.triangles[index]);
      if (!surface.colors.empty()) colors.push_back(surface.colors[index]);
    }
    Piece piece = extract(surface.points, triangles, colors);
    Part& part = division.parts.emplace_back();
    for (uint32_t point = 0; point < piece.sources.size(); ++point) {
      const uint32_t number = numbers[piece.sources[point]];
      if (number != none) part.borders.push_back({point, number});
    }
    part.surface = std::move(piece.surface);
  }
  return division;
}

}  // namespace triptych
