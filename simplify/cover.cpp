#include "simplify/cover.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

namespace triptych {

namespace {

/// Components with a larger radius than so many bounds lose too little to show.
constexpr double large = 8;
/// What is no larger than so many bounds may stand for others that vanished, and may be flat.
constexpr double small = 2;
/// A smaller loss than this share is left alone.
constexpr double negligible = 0.02;
/// At most this far, of the bound.
constexpr double furthest = 0.5;

/// The component of each point, numbered in order of appearance.
std::vector<uint32_t> components_of(const Surface& surface, size_t& count) {
  DisjointSets sets = connected_points(surface);
  std::vector<uint32_t> numbers(surface.points.size(), 0xffffffffu), component_of(surface.points.size());
  count = 0;
  for (uint32_t i = 0; i < surface.points.size(); ++i) {
    uint32_t& number = numbers[sets.root(i)];
    if (number == 0xffffffffu) number = static_cast<uint32_t>(count++);
    component_of[i] = number;
  }
  return component_of;
}

template <typename IsLocked>
std::vector<Cover> covers_of(const Surface& surface, const std::vector<uint32_t>& component_of, size_t count,
                             const IsLocked& is_locked) {
  std::vector<Cover> covers(count);
  std::vector<glm::dvec3> normals(count, glm::dvec3(0));
  std::vector<double> largest(count, -1);
  for (const Triangle& triangle : surface.triangles) {
    const uint32_t component = component_of[triangle.vertices[0]];
    Cover& cover = covers[component];
    std::array<glm::dvec3, 3> corners;
    for (size_t k = 0; k < 3; ++k) corners[k] = surface.points[triangle.vertices[k]];
    const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]) / 2.0;
    const double area = glm::length(normal);
    cover.area += area;
    normals[component] += normal;
    cover.middle += (corners[0] + corners[1] + corners[2]) / 3.0 * area;
    if (area > largest[component]) {
      largest[component] = area;
      cover.material = triangle.material;
    }
  }
  for (size_t i = 0; i < count; ++i) {
    Cover& cover = covers[i];
    if (!(cover.area > 0)) continue;
    cover.middle /= cover.area;
    cover.flatness = std::min(1.0, glm::length(normals[i]) / cover.area);
    cover.covered = cover.area / 4 * (1 + cover.flatness);
  }
  for (uint32_t i = 0; i < surface.points.size(); ++i) {
    Cover& cover = covers[component_of[i]];
    cover.radius = std::max(cover.radius, glm::distance(glm::dvec3(surface.points[i]), cover.middle));
    cover.locked = cover.locked || is_locked(i);
  }
  return covers;
}

}  // namespace

CoverKeeper::CoverKeeper(const Surface& source, std::span<const uint8_t> locked)
    : source_(source), locked_(locked) {
  size_t count = 0;
  component_of_ = components_of(source, count);
  covers_ =
      covers_of(source, component_of_, count, [&](uint32_t i) { return !locked.empty() && locked[i] != 0; });
}

double CoverKeeper::restore(Piece& level, double bound) const {
  Surface& surface = level.surface;
  size_t count = 0;
  const std::vector<uint32_t> component_of = components_of(surface, count);
  const std::vector<Cover> covers = covers_of(surface, component_of, count, [&](uint32_t i) {
    return !locked_.empty() && locked_[level.sources[i]] != 0;
  });
  // Each component of the source belongs to the first of the level that holds a point of it.
  std::vector<double> wanted(count, 0);
  std::vector<uint8_t> there(covers_.size(), 0);
  for (uint32_t i = 0; i < surface.points.size(); ++i) {
    const uint32_t own = component_of_[level.sources[i]];
    if (there[own]) continue;
    there[own] = 1;
    wanted[component_of[i]] += covers_[own].covered;
  }
  std::map<uint32_t, double> vanished, taking_over;  // by material
  for (size_t i = 0; i < covers_.size(); ++i) {
    if (!there[i]) vanished[covers_[i].material] += covers_[i].covered;
  }
  const auto takes_over = [&](size_t i) { return !covers[i].locked && covers[i].radius <= small * bound; };
  for (size_t i = 0; i < count; ++i) {
    if (takes_over(i)) taking_over[covers[i].material] += wanted[i];
  }
  std::vector<double> factors(count, 1);
  for (size_t i = 0; i < count; ++i) {
    const Cover& cover = covers[i];
    if (cover.locked || cover.radius > large * bound || !(cover.covered > 0)) continue;
    if (cover.flatness > 0.5 && !takes_over(i)) continue;
    double goal = wanted[i];
    if (takes_over(i) && vanished.count(cover.material) > 0 && taking_over[cover.material] > 0)
      goal *= 1 + vanished[cover.material] / taking_over[cover.material];
    if (goal <= cover.covered * (1 + negligible)) continue;
    factors[i] =
        std::min(std::sqrt(goal / cover.covered), 1 + furthest * bound / std::max(cover.radius, 1.0));
  }
  std::vector<glm::ivec3> points = surface.points;
  const LatticeBox box = source_.box();
  const auto grown = [&](uint32_t i) {
    const uint32_t own = component_of[i];
    if (factors[own] == 1) return surface.points[i];
    const glm::dvec3& middle = covers[own].middle;
    const glm::dvec3 point = glm::round(middle + (glm::dvec3(surface.points[i]) - middle) * factors[own]);
    return glm::clamp(glm::ivec3(point), box.lo, box.hi);
  };
  for (uint32_t i = 0; i < points.size(); ++i) points[i] = grown(i);
  for (const Triangle& triangle : surface.triangles) {  // rounding must leave each an area
    const auto& [a, b, c] = triangle.vertices;
    if (degenerate(points[a], points[b], points[c])) factors[component_of[a]] = 1;
  }
  double moved = 0;
  for (uint32_t i = 0; i < points.size(); ++i) {
    const glm::ivec3 point = grown(i);
    moved = std::max(moved, glm::distance(glm::dvec3(point), glm::dvec3(surface.points[i])));
    points[i] = point;
  }
  surface.points = std::move(points);
  return moved;
}

}  // namespace triptych
