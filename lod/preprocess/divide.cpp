#include "lod/preprocess/divide.hpp"

#include "lod/preprocess/buckets.hpp"

#include <algorithm>

namespace triptych {

std::vector<Part> divide(Surface surface, const PartitionLimits& limits, std::span<const glm::ivec3> shared) {
  std::vector<Part> parts;
  const auto groups = partition_triangles(surface, limits);
  if (groups.empty()) return parts;

  // How many parts use each point: none, one, or more; "more" too for what others share.
  constexpr uint32_t none = 0xffffffffu, several = 0xfffffffeu;
  std::vector<uint32_t> user(surface.points.size(), none);
  if (!shared.empty()) {
    for (size_t i = 0; i < user.size(); ++i) {
      if (std::binary_search(shared.begin(), shared.end(), surface.points[i], before)) user[i] = several;
    }
  }
  if (groups.size() > 1) {
    for (uint32_t group = 0; group < groups.size(); ++group) {
      for (const uint32_t index : groups[group]) {
        for (const uint32_t vertex : surface.triangles[index].vertices) {
          if (user[vertex] == none) user[vertex] = group;
          if (user[vertex] != group) user[vertex] = several;
        }
      }
    }
  }
  const auto add = [&](Part& part, std::span<const uint32_t> sources) {
    for (uint32_t point = 0; point < sources.size(); ++point) {
      if (user[sources[point]] == several)
        part.borders.push_back({point, static_cast<uint32_t>(part.borders.size())});
    }
  };
  std::vector<Triangle> triangles;
  for (const auto& group : groups) {
    triangles.clear();
    for (const uint32_t index : group) triangles.push_back(surface.triangles[index]);
    Piece piece = extract(surface.points, triangles);
    Part& part = parts.emplace_back();
    add(part, piece.sources);
    part.surface = std::move(piece.surface);
  }
  return parts;
}

}  // namespace triptych
