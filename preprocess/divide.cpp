#include "preprocess/divide.hpp"

namespace triptych {

Division divide(const Surface& surface, const PartitionLimits& limits, std::span<const SharedPoint> shared,
                uint32_t first_own) {
  Division division;
  division.first_own = first_own;
  const auto groups = partition_triangles(surface, limits);
  if (groups.empty()) return division;

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
  std::vector<CornerColors> colors;
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
