#include "scene/weld.hpp"

#include "base/hashing.hpp"

#include <algorithm>
#include <glm/glm.hpp>
#include <unordered_map>
#include <unordered_set>

namespace triptych {

namespace {

struct PointHash {
  size_t operator()(const glm::ivec3& point) const {
    return static_cast<size_t>(hash_values(std::span<const glm::ivec3>(&point, 1)));
  }
};

struct CornersHash {
  size_t operator()(const std::array<uint32_t, 3>& corners) const {
    return static_cast<size_t>(hash_values(std::span<const uint32_t>(corners)));
  }
};

}  // namespace

Welded weld(const Mesh& mesh, const Affine& transform, const Lattice& lattice,
            std::span<const uint32_t> colors) {
  Welded welded;
  Surface& surface = welded.surface;
  std::unordered_map<glm::ivec3, uint32_t, PointHash> places;
  places.reserve(mesh.positions.size());
  constexpr uint32_t unseen = 0xffffffffu;
  std::vector<uint32_t> place_of(mesh.positions.size(), unseen);
  const auto place = [&](uint32_t vertex) {
    if (place_of[vertex] != unseen) return place_of[vertex];
    const glm::ivec3 point = lattice.nearest(transform * glm::dvec4(mesh.positions[vertex], 1));
    const auto [found, inserted] = places.try_emplace(point, static_cast<uint32_t>(surface.points.size()));
    if (inserted) {
      surface.points.push_back(point);
    } else {
      ++welded.welded_vertices;
    }
    return place_of[vertex] = found->second;
  };

  const bool mirrors = glm::determinant(glm::dmat3(transform)) < 0;
  std::unordered_set<std::array<uint32_t, 3>, CornersHash> seen;
  seen.reserve(mesh.triangles.size());
  surface.triangles.reserve(mesh.triangles.size());
  for (const Triangle& triangle : mesh.triangles) {
    std::array<uint32_t, 3> corners = {place(triangle.vertices[0]), place(triangle.vertices[1]),
                                       place(triangle.vertices[2])};
    if (mirrors) std::swap(corners[1], corners[2]);
    std::array<uint32_t, 3> turned = corners;
    std::rotate(turned.begin(), std::min_element(turned.begin(), turned.end()), turned.end());
    if (degenerate(surface.points[corners[0]], surface.points[corners[1]], surface.points[corners[2]]) ||
        !seen.insert(turned).second) {
      ++welded.dropped_triangles;
    } else {
      surface.triangles.push_back({corners, colors[triangle.material]});
    }
  }
  // Points that only dropped triangles used are left out.
  surface = extract(surface.points, surface.triangles).surface;
  return welded;
}

}  // namespace triptych
