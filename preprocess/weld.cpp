#include "preprocess/weld.hpp"

#include "model/read_mesh.hpp"
#include "scene/skeleton.hpp"
#include "simplify/key_hash.hpp"

#include <algorithm>
#include <compare>
#include <tsl/robin_map.h>
#include <vector>

namespace triptych {

namespace {

class Welder {
 public:
  Welder(size_t triangles, const CornerStreams& streams) : streams_(streams) {
    places_.reserve(triangles / 2 + 4);
    surface.triangles.reserve(triangles);
  }

  void add(const std::array<glm::ivec3, 3>& points, const LatticeTriangle& triangle) {
    std::array<uint32_t, 3> corners;
    for (size_t i = 0; i < 3; ++i) {
      const auto [found, inserted] =
          places_.try_emplace(points[i], static_cast<uint32_t>(surface.points.size()));
      if (inserted) surface.points.push_back(points[i]);
      corners[i] = found->second;
    }
    surface.triangles.push_back({corners, triangle.color});
    if (streams_.colors || streams_.coordinates || streams_.light)
      surface.colors.push_back({triangle.corner_colors, triangle.coordinates, triangle.light});
    if (streams_.normals) surface.normals.push_back(triangle.corner_normals);
  }
  bool has(const glm::ivec3& point) const { return places_.contains(point); }

  Surface surface;

 private:
  CornerStreams streams_;
  tsl::robin_map<glm::ivec3, uint32_t, KeyHash> places_;
};

/// For each triangle whether the same one, with the same winding, came before. Only triangles with the same
/// least corner are compared.
std::vector<uint8_t> repeated_triangles(const Surface& surface) {
  struct Turned {
    uint32_t second, third, index;
    auto operator<=>(const Turned&) const = default;
  };
  const size_t count = surface.triangles.size();
  std::vector<uint32_t> ends(surface.points.size() + 1, 0);  // where each corner's triangles end
  const auto least = [&](size_t i) {
    const auto& vertices = surface.triangles[i].vertices;
    return static_cast<size_t>(std::min_element(vertices.begin(), vertices.end()) - vertices.begin());
  };
  for (size_t i = 0; i < count; ++i) ++ends[surface.triangles[i].vertices[least(i)] + 1];
  for (size_t point = 0; point + 1 < ends.size(); ++point) ends[point + 1] += ends[point];
  std::vector<Turned> turned(count);
  for (size_t i = 0; i < count; ++i) {
    const auto& vertices = surface.triangles[i].vertices;
    const size_t at = least(i);
    turned[ends[vertices[at]]++] = {vertices[(at + 1) % 3], vertices[(at + 2) % 3], static_cast<uint32_t>(i)};
  }
  std::vector<uint8_t> repeated(count, 0);
  for (size_t point = 0, first = 0; point + 1 < ends.size(); first = ends[point++]) {
    const std::span<Turned> own = std::span(turned).subspan(first, ends[point] - first);
    std::sort(own.begin(), own.end());
    for (size_t i = 1; i < own.size(); ++i)
      repeated[own[i].index] = own[i].second == own[i - 1].second && own[i].third == own[i - 1].third;
  }
  return repeated;
}

}  // namespace

Welded weld(std::span<const LatticeTriangle> triangles, const CornerStreams& streams) {
  Welded welded;
  Welder welder(triangles.size(), streams);
  std::vector<const LatticeTriangle*> flat;
  for (const LatticeTriangle& triangle : triangles) {
    const auto& [a, b, c] = triangle.corners;
    if (triangle.color == no_id) {
      ++welded.dropped_triangles;
    } else if (degenerate(a, b, c)) {
      flat.push_back(&triangle);
    } else {
      welder.add(triangle.corners, triangle);
    }
  }
  const size_t with_area_before = welder.surface.triangles.size();
  for (const LatticeTriangle* triangle : flat) {
    const auto& [a, b, c] = triangle->corners;
    const int there = welder.has(a) + welder.has(b) + welder.has(c);
    if (there == 3) {
      ++welded.dropped_triangles;
      continue;
    }
    welder.add(with_area(triangle->corners), *triangle);
    ++welded.enlarged_triangles;
    welded.lone_triangles += there == 0;
  }
  const std::vector<uint8_t> repeated = repeated_triangles(welder.surface);
  std::vector<Triangle>& kept = welder.surface.triangles;
  std::vector<SurfaceCorners>& kept_colors = welder.surface.colors;
  std::vector<CornerNormals>& kept_normals = welder.surface.normals;
  const bool colored = streams.colors || streams.coordinates || streams.light;
  size_t next = 0;
  for (size_t i = 0; i < kept.size(); ++i) {
    if (!repeated[i]) {
      if (colored) kept_colors[next] = kept_colors[i];
      if (streams.normals) kept_normals[next] = kept_normals[i];
      kept[next++] = kept[i];
    } else if (i < with_area_before) {
      ++welded.dropped_triangles;
    }
  }
  kept.resize(next);
  if (colored) kept_colors.resize(next);
  if (streams.normals) kept_normals.resize(next);
  welder.surface.file_normals = streams.normals;
  welded.surface = std::move(welder.surface);
  return welded;
}

Welded weld(const Mesh& mesh, const Affine& transform, const Lattice& lattice, const MeshColors& colors) {
  if (const auto loaded = mesh.stream ? mesh.stream->load() : nullptr)
    return weld(*loaded, transform, lattice, colors);
  const CornerStreams streams = corner_streams(mesh, colors);
  const ToLattice to_lattice(transform, lattice, colors);
  std::vector<LatticeTriangle> triangles;
  triangles.reserve(mesh.triangle_count());
  uint64_t not_finite = read_mesh(mesh, [&](std::span<const CornerTriangle> batch) {
    for (const CornerTriangle& triangle : batch) triangles.push_back(to_lattice(triangle));
  });
  Welded welded = weld(triangles, streams);
  welded.dropped_triangles += not_finite;
  if (!mesh.stream) {
    std::vector<uint8_t> used(mesh.positions.size(), 0);
    for (size_t i = 0; i < mesh.triangles.size(); ++i) {
      // The points of a dropped triangle do not count as welded.
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
