#include "scene/weld.hpp"

#include "scene/key_hash.hpp"

#include <algorithm>
#include <tsl/robin_map.h>
#include <tsl/robin_set.h>
#include <vector>

namespace triptych {

Welded weld(std::span<const LatticeTriangle> triangles) {
  Welded welded;
  Surface& surface = welded.surface;
  tsl::robin_map<glm::ivec3, uint32_t, KeyHash> places;
  tsl::robin_set<std::array<uint32_t, 3>, KeyHash, KeyEqual> seen;
  places.reserve(triangles.size() / 2 + 4);
  seen.reserve(triangles.size());
  surface.triangles.reserve(triangles.size());
  for (const LatticeTriangle& triangle : triangles) {
    const auto& [a, b, c] = triangle.corners;
    if (degenerate(a, b, c)) {
      ++welded.dropped_triangles;
      continue;
    }
    std::array<uint32_t, 3> corners;
    for (size_t i = 0; i < 3; ++i) {
      const auto [found, inserted] =
          places.try_emplace(triangle.corners[i], static_cast<uint32_t>(surface.points.size()));
      if (inserted) surface.points.push_back(triangle.corners[i]);
      corners[i] = found->second;
    }
    std::array<uint32_t, 3> turned = corners;
    std::rotate(turned.begin(), std::min_element(turned.begin(), turned.end()), turned.end());
    if (seen.insert(turned).second) {
      surface.triangles.push_back({corners, triangle.color});
    } else {
      ++welded.dropped_triangles;
    }
  }
  return welded;
}

Welded weld(const Mesh& mesh, const Affine& transform, const Lattice& lattice,
            std::span<const uint32_t> colors) {
  if (const auto loaded = mesh.stream ? mesh.stream->load() : nullptr)
    return weld(*loaded, transform, lattice, colors);
  const ToLattice to_lattice(transform, lattice, colors);
  std::vector<LatticeTriangle> triangles;
  triangles.reserve(mesh.triangle_count());
  uint64_t not_finite = read_mesh(mesh, [&](std::span<const CornerTriangle> batch) {
    for (const CornerTriangle& triangle : batch) triangles.push_back(to_lattice(triangle));
  });
  Welded welded = weld(triangles);
  welded.dropped_triangles += not_finite;
  if (!mesh.stream) {
    std::vector<uint8_t> used(mesh.positions.size(), 0);
    for (size_t i = 0; i < mesh.triangles.size(); ++i) {
      // A triangle without area leaves no points behind, and that is no welding.
      const bool dropped = not_finite == 0 && degenerate(triangles[i].corners[0], triangles[i].corners[1],
                                                         triangles[i].corners[2]);
      if (dropped) continue;
      for (const uint32_t vertex : mesh.triangles[i].vertices) used[vertex] = 1;
    }
    const auto vertices = static_cast<uint64_t>(std::count(used.begin(), used.end(), 1));
    welded.welded_vertices = vertices - std::min<uint64_t>(vertices, welded.surface.points.size());
  }
  return welded;
}

}  // namespace triptych
