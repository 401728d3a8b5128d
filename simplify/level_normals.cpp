#include "simplify/level_normals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace triptych {

namespace {

/// Cosines. Normals that differ by less than a degree look the same; a triangle lies in a facet whose normal
/// is not half a degree off.
constexpr float alike = 0.99985f, in_facet = 0.99996f;
/// Corners of one smooth surface: facets meet there at no more than 40 degrees, normals of files by no more
/// than 20, since those of an edge that is meant to be seen differ.
constexpr float smooth_facets = 0.766f, smooth_corners = 0.94f;
/// What the source shows at a point has to do with the triangle: 60 degrees.
constexpr float related = 0.5f;

glm::vec3 unit(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0 ? glm::vec3(v / length) : glm::vec3(0);
}

glm::dvec3 edge(const Surface& surface, const Triangle& triangle, size_t from, size_t to) {
  return glm::dvec3(surface.points[triangle.vertices[to]]) -
         glm::dvec3(surface.points[triangle.vertices[from]]);
}

glm::vec3 facet_normal(const Surface& surface, const Triangle& triangle) {
  return unit(glm::cross(edge(surface, triangle, 0, 1), edge(surface, triangle, 0, 2)));
}

float angle_at(const Surface& surface, const Triangle& triangle, size_t corner) {
  const glm::dvec3 a = edge(surface, triangle, corner, (corner + 1) % 3),
                   b = edge(surface, triangle, corner, (corner + 2) % 3);
  return static_cast<float>(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

}  // namespace

LevelNormals::LevelNormals(const Surface& source) : source_(source), first_(source.points.size() + 1, 0) {
  for (const Triangle& triangle : source.triangles) {
    for (const uint32_t point : triangle.vertices) ++first_[point + 1];
  }
  for (size_t point = 0; point + 1 < first_.size(); ++point) first_[point + 1] += first_[point];
  corners_.resize(3 * source.triangles.size());
  std::vector<uint32_t> next(first_.begin(), first_.end() - 1);
  for (uint32_t t = 0; t < source.triangles.size(); ++t) {
    const Triangle& triangle = source.triangles[t];
    const glm::vec3 facet = facet_normal(source, triangle);
    const bool own = !source.normals.empty() && has_normal(source.normals[t][0]);
    for (uint8_t k = 0; k < 3; ++k) {
      const glm::vec3 normal = own ? unit(direction_of(source.normals[t][k])) : facet;
      corners_[next[triangle.vertices[k]]++] = {t, k, own, normal, angle_at(source, triangle, k)};
    }
  }
}

/// The triangle of the source at these points, turned so that the first one is its first corner.
const LevelNormals::Corner* LevelNormals::find(const std::array<uint32_t, 3>& points) const {
  for (const Corner& corner : corners_at(points[0])) {
    const auto& vertices = source_.triangles[corner.triangle].vertices;
    if (vertices[(corner.number + 1u) % 3] == points[1] && vertices[(corner.number + 2u) % 3] == points[2])
      return &corner;
  }
  return nullptr;
}

CornerNormals LevelNormals::normals_of(const Piece& level, const Triangle& triangle) const {
  std::array<uint32_t, 3> points;
  for (size_t k = 0; k < 3; ++k) points[k] = level.sources[triangle.vertices[k]];
  if (const Corner* const same = find(points)) {
    CornerNormals normals{};
    if (!same->own) return normals;
    const CornerNormals& there = source_.normals[same->triangle];
    for (size_t k = 0; k < 3; ++k) normals[k] = there[(same->number + k) % 3];
    return normals;
  }
  const glm::vec3 facet = facet_normal(level.surface, triangle);
  std::array<const Corner*, 3> nearest{};
  bool lies_in_facets = true;
  for (size_t k = 0; k < 3; ++k) {
    float best = related;
    for (const Corner& corner : corners_at(points[k])) {
      const float cosine = glm::dot(corner.normal, facet);
      if (cosine > best || (cosine == best && !nearest[k])) {
        best = cosine;
        nearest[k] = &corner;
      }
    }
    if (!nearest[k]) return {};
    lies_in_facets = lies_in_facets && best > in_facet;
  }
  if (lies_in_facets) return {};
  CornerNormals normals{};
  bool differs = false;
  for (size_t k = 0; k < 3; ++k) {
    glm::vec3 sum(0);
    for (const Corner& corner : corners_at(points[k])) {
      const float cosine = glm::dot(corner.normal, nearest[k]->normal);
      const bool smooth = cosine > (corner.own && nearest[k]->own ? smooth_corners : smooth_facets);
      if (smooth) sum += corner.normal * corner.angle;
    }
    const glm::vec3 normal = unit(glm::dvec3(sum));
    differs = differs || glm::dot(normal, facet) < alike;
    normals[k] = to_vertex_normal(glm::dvec3(normal));
    if (!has_normal(normals[k])) return {};
  }
  return differs ? normals : CornerNormals{};
}

void LevelNormals::shade(Piece& level) const {
  level.surface.normals.clear();
  for (const Triangle& triangle : level.surface.triangles)
    level.surface.normals.push_back(normals_of(level, triangle));
  level.surface.file_normals = source_.file_normals;
  level.surface.drop_empty_normals();
}

void drop_plain_normals(Surface& surface) {
  for (size_t t = 0; t < surface.normals.size(); ++t) {
    CornerNormals& own = surface.normals[t];
    const glm::vec3 facet = facet_normal(surface, surface.triangles[t]);
    std::array<glm::vec3, 3> normals;
    float least = 1, sum = 0;
    bool all = true;
    for (size_t k = 0; k < 3; ++k) {
      all = all && has_normal(own[k]);
      normals[k] = unit(direction_of(own[k]));
      sum += glm::dot(normals[k], facet);
    }
    for (size_t k = 0; k < 3; ++k) {
      if (sum < 0) normals[k] = -normals[k];
      least = std::min(least, glm::dot(normals[k], facet));
      if (sum < 0) own[k] = to_vertex_normal(glm::dvec3(normals[k]));
    }
    if (!all || least > alike) own = {};
  }
  surface.drop_empty_normals();
}

}  // namespace triptych
