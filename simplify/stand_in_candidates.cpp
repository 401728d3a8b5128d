#include "simplify/stand_in_candidates.hpp"

#include "simplify/component_covers.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

namespace triptych {

namespace {

constexpr size_t least_triangles = 8, most_triangles = 512;
/// Corners may be so far above the planes of triangles, as a share of the radius.
constexpr double hollow = 0.01;

/// Whether it is closed and convex; says whether it is inside out, too.
bool is_convex(StandInComponent& component, double radius) {
  const Surface& surface = component.piece.surface;
  const double most = std::max(in_plane_rounding, hollow * radius);
  std::map<std::pair<uint32_t, uint32_t>, int> sides;
  bool above = false, below = false;
  for (const Triangle& triangle : surface.triangles) {
    const auto& [a, b, c] = triangle.vertices;
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
      if (++sides[{from, to}] > 1) return false;
    }
    const glm::dvec3 origin(surface.points[a]);
    const glm::dvec3 normal = glm::normalize(area_normal(origin, surface.points[b], surface.points[c]));
    for (const glm::ivec3& point : surface.points) {
      const double height = glm::dot(glm::dvec3(point) - origin, normal);
      above = above || height > most;
      below = below || height < -most;
    }
    if (above && below) return false;
  }
  component.is_inside_out = above;
  return std::ranges::all_of(sides, [&](const auto& side) {
    return sides.contains({side.first.second, side.first.first});
  });
}

/// The plane in which all held points lie; false if there is none, true without one if none are held.
bool find_base(StandInComponent& component) {
  const Surface& surface = component.piece.surface;
  std::vector<uint8_t> held = component.locked;
  for (const Triangle& triangle : surface.triangles) {
    if (triangle.material == palette_index(triangle.material)) continue;
    for (const uint32_t vertex : triangle.vertices) held[vertex] = 1;
  }
  if (std::ranges::count(held, 1) == 0) return true;
  for (const Triangle& triangle : surface.triangles) {
    const auto& [a, b, c] = triangle.vertices;
    const glm::dvec3 origin(surface.points[a]);
    const glm::dvec3 inward = glm::normalize(area_normal(origin, surface.points[b], surface.points[c])) *
                              (component.is_inside_out ? 1.0 : -1.0);
    bool holds_all = true;
    for (size_t i = 0; i < held.size() && holds_all; ++i)
      holds_all = !held[i] ||
                  std::abs(glm::dot(glm::dvec3(surface.points[i]) - origin, inward)) <= in_plane_rounding / 2;
    if (!holds_all) continue;
    component.base = {origin, inward};
    return true;
  }
  return false;
}

/// What two components have in common that are each other moved.
std::vector<int32_t> shape_key(const StandInComponent& of) {
  const Piece& component = of.piece;
  std::vector<int32_t> key(of.locked.begin(), of.locked.end());
  for (const glm::ivec3& point : component.surface.points) {
    for (int axis = 0; axis < 3; ++axis) key.push_back(point[axis] - component.surface.points[0][axis]);
  }
  for (const Triangle& triangle : component.surface.triangles) {
    for (const uint32_t vertex : triangle.vertices) key.push_back(static_cast<int32_t>(vertex));
    key.push_back(static_cast<int32_t>(triangle.material - palette_index(triangle.material)));
  }
  return key;
}

/// The triangles of each component that may have stand-ins: of one colour, not too few and not too many.
/// Empty of the others.
std::vector<std::vector<uint32_t>> triangles_of_candidates(const Surface& surface,
                                                           const ComponentCovers& covers) {
  std::vector<std::vector<uint32_t>> triangles(covers.covers.size());
  std::vector<uint8_t> refused(triangles.size(), 0);
  for (uint32_t i = 0; i < surface.triangles.size(); ++i) {
    const Triangle& triangle = surface.triangles[i];
    const uint32_t component = covers.component_of[triangle.vertices[0]];
    std::vector<uint32_t>& own = triangles[component];
    if (own.size() <= most_triangles) own.push_back(i);
    if (palette_index(triangle.material) != palette_index(surface.triangles[own.front()].material))
      refused[component] = 1;
  }
  for (size_t i = 0; i < triangles.size(); ++i) {
    if (refused[i] || triangles[i].size() < least_triangles || triangles[i].size() > most_triangles)
      triangles[i].clear();
  }
  return triangles;
}

StandInCandidate candidate_of(const Surface& surface, std::span<const uint8_t> locked,
                              std::vector<uint32_t> triangles) {
  std::vector<Triangle> own;
  for (const uint32_t triangle : triangles) own.push_back(surface.triangles[triangle]);
  StandInComponent component{.piece = extract(surface.points, own), .locked = {}, .base = {}};
  for (const uint32_t source : component.piece.sources)
    component.locked.push_back(locked.empty() ? 0 : locked[source]);
  return {std::move(component), std::move(triangles)};
}

}  // namespace

std::vector<StandInCandidate> stand_in_candidates(const Surface& surface, std::span<const uint8_t> locked,
                                                  size_t least) {
  if (!surface.colors.empty()) return {};
  const ComponentCovers covers(surface);
  std::vector<std::vector<uint32_t>> triangles = triangles_of_candidates(surface, covers);
  size_t in_candidates = 0, in_convex = 0;
  for (const std::vector<uint32_t>& own : triangles) in_candidates += own.size();
  if (in_candidates < least) return {};
  std::vector<StandInCandidate> candidates;
  std::map<std::vector<int32_t>, size_t> known;
  for (size_t i = 0; i < triangles.size(); ++i) {
    if (triangles[i].empty()) continue;
    StandInCandidate next = candidate_of(surface, locked, std::move(triangles[i]));
    next.like = known.try_emplace(shape_key(next.component), candidates.size()).first->second;
    next.is_convex = next.like < candidates.size()
                         ? candidates[next.like].is_convex
                         : is_convex(next.component, covers.covers[i].radius) && find_base(next.component);
    if (next.is_convex) in_convex += next.triangles.size();
    candidates.push_back(std::move(next));
  }
  if (in_convex < least) return {};
  return candidates;
}

}  // namespace triptych
