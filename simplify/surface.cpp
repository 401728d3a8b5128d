#include "simplify/surface.hpp"

#include "simplify/key_hash.hpp"

#include <algorithm>
#include <bit>
#include <numeric>
#include <tsl/robin_map.h>
#include <type_traits>

namespace triptych {

LatticeBox Surface::box() const {
  LatticeBox box;
  for (const glm::ivec3& point : points) box.extend(point);
  return box;
}

void Surface::drop_empty_normals() {
  if (std::ranges::any_of(normals, [](const CornerNormals& own) { return has_normal(own[0]); })) return;
  normals.clear();
  file_normals = false;
}

Piece extract(const std::vector<glm::ivec3>& points, std::span<const Triangle> triangles,
              std::span<const SurfaceCorners> colors) {
  Piece piece;
  piece.surface.colors.assign(colors.begin(), colors.end());
  tsl::robin_map<uint32_t, uint32_t, KeyHash> local;
  local.reserve(triangles.size() / 2 + 16);
  piece.surface.triangles.assign(triangles.begin(), triangles.end());
  for (Triangle& triangle : piece.surface.triangles) {
    for (uint32_t& vertex : triangle.vertices) {
      const auto [found, inserted] = local.try_emplace(vertex, static_cast<uint32_t>(piece.sources.size()));
      if (inserted) {
        piece.sources.push_back(vertex);
        piece.surface.points.push_back(points[vertex]);
      }
      vertex = found->second;
    }
  }
  return piece;
}

Piece extract(const Surface& surface, std::span<const uint32_t> chosen) {
  const auto those = [&](const auto& values) {
    std::remove_cvref_t<decltype(values)> result;
    if (values.empty()) return result;
    result.reserve(chosen.size());
    for (const uint32_t triangle : chosen) result.push_back(values[triangle]);
    return result;
  };
  Piece piece = extract(surface.points, those(surface.triangles), those(surface.colors));
  piece.surface.normals = those(surface.normals);
  piece.surface.file_normals = surface.file_normals;
  piece.surface.drop_empty_normals();
  return piece;
}

Piece without_lone_points(const Surface& surface) {
  std::vector<uint32_t> all(surface.triangles.size());
  std::iota(all.begin(), all.end(), 0u);
  return extract(surface, all);
}

bool is_seen_through(const Surface& surface, Palette palette) {
  return std::ranges::any_of(surface.triangles, [&](const Triangle& triangle) {
    return is_seen_through(palette, palette_index(triangle.material));
  });
}

DisjointSets connected_points(const Surface& surface) {
  DisjointSets sets(surface.points.size());
  for (const auto& [vertices, material] : surface.triangles) {
    sets.join(vertices[0], vertices[1]);
    sets.join(vertices[0], vertices[2]);
  }
  return sets;
}

Chunk make_chunk(const Surface& surface, std::span<const uint8_t> pieces) {
  constexpr uint32_t none = 0xffffffffu;
  Chunk chunk;
  chunk.vertices.reserve(surface.points.size());
  chunk.indices.reserve(surface.triangles.size() * 3);
  // A point has a vertex for each of its colours and pieces; most have only one, and the map is for the
  // others.
  std::vector<uint32_t> first(surface.points.size(), none);
  using Key = std::array<uint32_t, 8>;
  tsl::robin_map<Key, uint32_t, KeyHash, KeyEqual> further;
  const auto any = [&](const auto& has) {
    return std::ranges::any_of(
        surface.colors, [&](const SurfaceCorners& corners) { return std::ranges::any_of(corners, has); });
  };
  const bool colored = any([](const SurfaceCorner& corner) { return is_colored(corner.color); });
  const bool textured = any([](const SurfaceCorner& corner) { return is_on_texture(corner.coordinates); });
  const bool lit = any([](const SurfaceCorner& corner) { return has_light(corner.light); });
  const bool shaded = !surface.normals.empty();
  if (shaded) chunk.normals_from = surface.file_normals ? ChunkNormals::of_files : ChunkNormals::of_levels;
  const auto differs = [&](uint32_t index, const ChunkVertex& vertex, const SurfaceCorner& own,
                           const VertexNormal& normal) {
    return chunk.vertices[index] != vertex || (colored && chunk.colors[index] != own.color) ||
           (textured && chunk.coordinates[index] != own.coordinates) ||
           (lit && chunk.light[index] != own.light) || (shaded && chunk.normals[index] != normal);
  };
  for (size_t i = 0; i < surface.triangles.size(); ++i) {
    const uint32_t material = surface.triangles[i].material;
    const uint8_t piece = pieces.empty() ? 0 : pieces[i];
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t point = surface.triangles[i].vertices[k];
      const SurfaceCorner own = surface.colors.empty() ? SurfaceCorner() : surface.colors[i][k];
      const VertexNormal normal = shaded ? surface.normals[i][k] : VertexNormal{};
      ChunkVertex vertex{surface.points[point], 0, 0, piece};
      vertex.color = palette_index(material) & (max_colors - 1);
      vertex.layer = layer_of(material) & max_layer;
      const auto next = static_cast<uint32_t>(chunk.vertices.size());
      if (first[point] == none) first[point] = next;
      uint32_t index = first[point];
      if (index != next && differs(index, vertex, own, normal)) {
        const Key key{point,
                      material,
                      std::bit_cast<uint32_t>(own.color),
                      std::bit_cast<uint32_t>(normal),
                      piece,
                      static_cast<uint32_t>(own.coordinates.u),
                      static_cast<uint32_t>(own.coordinates.v),
                      std::bit_cast<uint32_t>(own.light)};
        index = further.try_emplace(key, next).first->second;
      }
      if (index == next) {
        chunk.vertices.push_back(vertex);
        if (colored) chunk.colors.push_back(own.color);
        if (textured) chunk.coordinates.push_back(own.coordinates);
        if (lit) chunk.light.push_back(own.light);
        if (shaded) chunk.normals.push_back(normal);
      }
      chunk.indices.push_back(index);
    }
  }
  return chunk;
}

bool degenerate(const glm::ivec3& a, const glm::ivec3& b, const glm::ivec3& c) {
  // Differences fit 30 bits and more, their products 61: exact in 64.
  const int64_t ux = int64_t{b.x} - a.x, uy = int64_t{b.y} - a.y, uz = int64_t{b.z} - a.z;
  const int64_t vx = int64_t{c.x} - a.x, vy = int64_t{c.y} - a.y, vz = int64_t{c.z} - a.z;
  return uy * vz == uz * vy && uz * vx == ux * vz && ux * vy == uy * vx;
}

std::array<glm::ivec3, 3> with_area(const std::array<glm::ivec3, 3>& corners) {
  const std::array<glm::ivec3, 4> steps = {glm::ivec3{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const glm::ivec3& b : steps) {
    for (const glm::ivec3& c : steps) {
      if (!degenerate(corners[0], corners[1] + b, corners[2] + c))
        return {corners[0], corners[1] + b, corners[2] + c};
    }
  }
  return corners;  // not reached: of three directions at most one is that of the line
}

}  // namespace triptych
