#include "scene/weld.hpp"

#include "scene/key_hash.hpp"
#include "scene/skeleton.hpp"

#include <algorithm>
#include <tsl/robin_map.h>
#include <tsl/robin_set.h>
#include <vector>

namespace triptych {

namespace {

class Welder {
 public:
  explicit Welder(size_t triangles) {
    places_.reserve(triangles / 2 + 4);
    seen_.reserve(triangles);
    welded.surface.triangles.reserve(triangles);
  }

  /// False if the same one was there before.
  bool add(const std::array<glm::ivec3, 3>& points, uint32_t color) {
    Surface& surface = welded.surface;
    std::array<uint32_t, 3> corners;
    for (size_t i = 0; i < 3; ++i) {
      const auto [found, inserted] =
          places_.try_emplace(points[i], static_cast<uint32_t>(surface.points.size()));
      if (inserted) surface.points.push_back(points[i]);
      corners[i] = found->second;
    }
    std::array<uint32_t, 3> turned = corners;
    std::rotate(turned.begin(), std::min_element(turned.begin(), turned.end()), turned.end());
    if (!seen_.insert(turned).second) return false;
    surface.triangles.push_back({corners, color});
    return true;
  }
  bool has(const glm::ivec3& point) const { return places_.contains(point); }

  Welded welded;

 private:
  tsl::robin_map<glm::ivec3, uint32_t, KeyHash> places_;
  tsl::robin_set<std::array<uint32_t, 3>, KeyHash, KeyEqual> seen_;
};

}  // namespace

Welded weld(std::span<const LatticeTriangle> triangles) {
  Welder welder(triangles.size());
  Welded& welded = welder.welded;
  std::vector<const LatticeTriangle*> flat;
  for (const LatticeTriangle& triangle : triangles) {
    const auto& [a, b, c] = triangle.corners;
    if (triangle.color != no_id && degenerate(a, b, c)) {
      flat.push_back(&triangle);
    } else if (triangle.color == no_id || !welder.add(triangle.corners, triangle.color)) {
      ++welded.dropped_triangles;
    }
  }
  for (const LatticeTriangle* triangle : flat) {
    const auto& [a, b, c] = triangle->corners;
    const int there = welder.has(a) + welder.has(b) + welder.has(c);
    if (there == 3) {
      ++welded.dropped_triangles;
      continue;
    }
    welder.add(with_area(triangle->corners), triangle->color);
    ++welded.enlarged_triangles;
    welded.lone_triangles += there == 0;
  }
  return std::move(welded);
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
