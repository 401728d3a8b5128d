#include "simplify/component_covers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace triptych {

namespace {

/// A component is long if its radius is more than so many times its thickness.
constexpr double long_from = 6;
/// A wire's is more than so many times what is across.
constexpr double wire_from = 30;
/// And rods.
constexpr double rod_from = 12;
/// Normals of what is closed cancel to less than this share of the area.
constexpr double closed_flatness = 0.1;

}  // namespace

bool Cover::is_long() const { return radius > long_from * thickness * (1 + flatness); }

double Cover::across() const { return area / (4 * std::numbers::pi * radius); }

bool Cover::is_rod() const { return radius > rod_from * across(); }

bool Cover::is_wire() const { return radius > wire_from * across(); }

double mean_cover(double area, const glm::dvec3& normals) {
  return (area + std::min(area, glm::length(normals))) / 4;
}

ComponentCovers::ComponentCovers(const Surface& surface) {
  DisjointSets sets = connected_points(surface);
  constexpr uint32_t none = 0xffffffffu;
  std::vector<uint32_t> numbers(surface.points.size(), none);
  component_of.resize(surface.points.size());
  uint32_t count = 0;
  for (uint32_t i = 0; i < surface.points.size(); ++i) {
    uint32_t& number = numbers[sets.root(i)];
    if (number == none) number = count++;
    component_of[i] = number;
  }
  covers.resize(count);
  std::vector<glm::dvec3> normals(count, glm::dvec3(0)), origins(count);
  std::vector<double> largest(count, -1), volumes(count, 0);
  for (uint32_t i = 0; i < surface.points.size(); ++i) origins[component_of[i]] = surface.points[i];
  for (const Triangle& triangle : surface.triangles) {
    const uint32_t component = component_of[triangle.vertices[0]];
    Cover& cover = covers[component];
    std::array<glm::dvec3, 3> corners;
    for (size_t k = 0; k < 3; ++k)
      corners[k] = glm::dvec3(surface.points[triangle.vertices[k]]) - origins[component];
    const glm::dvec3 normal = area_normal(corners[0], corners[1], corners[2]);
    const double area = glm::length(normal);
    cover.area += area;
    normals[component] += normal;
    volumes[component] += glm::dot(corners[0], normal) / 3;
    cover.middle += (corners[0] + corners[1] + corners[2]) / 3.0 * area;
    if (area > largest[component]) {
      largest[component] = area;
      cover.material = palette_index(triangle.material);
    }
  }
  for (size_t i = 0; i < count; ++i) {
    Cover& cover = covers[i];
    if (!(cover.area > 0)) continue;
    cover.middle /= cover.area;
    volumes[i] -= glm::dot(cover.middle, normals[i]) / 3;  // seen from its middle, if it is not closed
    cover.middle += origins[i];
    cover.flatness = std::min(1.0, glm::length(normals[i]) / cover.area);
    cover.covered = mean_cover(cover.area, normals[i]);
  }
  for (uint32_t i = 0; i < surface.points.size(); ++i) {
    Cover& cover = covers[component_of[i]];
    cover.radius = std::max(cover.radius, glm::distance(glm::dvec3(surface.points[i]), cover.middle));
  }
  for (size_t i = 0; i < count; ++i) {
    Cover& cover = covers[i];
    if (!(cover.radius > 0)) continue;
    // Exact for a ball and, nearly, for a straight wire. What is wound up or a mesh of wires has more area
    // for its radius, and shows by its volume how thick it is.
    cover.thickness = cover.area / (4 * std::numbers::pi * cover.radius);
    const double by_volume = cover.area > 0 ? 3 * std::abs(volumes[i]) / cover.area : 0;
    if (cover.flatness < closed_flatness && by_volume > cover.thickness / 100)
      cover.thickness = std::min(cover.thickness, by_volume);
  }
}

}  // namespace triptych
