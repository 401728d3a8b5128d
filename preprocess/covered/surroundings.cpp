#include "preprocess/covered/surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace triptych {

Surroundings::Surroundings(const Parts& parts, const PlacedParts& hierarchy, PartCache<PartRegions>& cache,
                           uint32_t placed, const std::vector<std::pair<uint32_t, Box>>& others,
                           double tolerance)
    : parts_(parts),
      hierarchy_(hierarchy),
      cache_(cache),
      tolerance_(tolerance),
      own_(parts, hierarchy, placed, cache) {
  for (const auto& [number, box] : others) {
    const PartInfo& info = parts.parts[hierarchy.placed[number].part];
    if (info.transparent && number != placed) continue;  // it hides nothing
    const bool is_body = number != placed && info.outside != Outside::none && info.borders == 0;
    others_.push_back({number, grown(box, tolerance), is_body});
  }
}

const PlacedRegions& Surroundings::placed(Other& other) {
  if (!other.placed) other.placed.emplace(parts_, hierarchy_, other.number, cache_);
  return *other.placed;
}

std::vector<uint32_t> Surroundings::reaching(const Box& near, const Box& inside) {
  std::vector<uint32_t> numbers;
  for (Other& other : others_) {
    if (other.number != own_.number) {
      if (!overlap(other.box, near)) continue;
      const PlacedRegions& of = placed(other);
      bool is_any = false;
      of.regions->tree.visit_while(of.in(other.is_body ? inside : near), [&](uint32_t) {
        is_any = true;
        return false;
      });
      if (!is_any) continue;
    }
    numbers.push_back(other.number);
  }
  return numbers;
}

void Surroundings::look(Other& other, uint32_t region, const glm::dvec3& from, const glm::dvec3& way,
                        double reach, std::optional<First>& first) {
  const PlacedRegions& placed = this->placed(other);
  const PartRegions& regions = *placed.regions;
  // In the other's own space, where lengths along the ray are the same.
  const glm::dvec3 start = placed.in(from), direction = placed.inverse * way;
  // What lies behind by more than rounding is the other side of a thin plate, and covers nothing.
  const double behind = -tolerance_ / 8;
  RaySpan ray(start, direction, behind, first ? std::min(reach, first->along) : reach);
  const auto meet = [&](uint32_t triangle) {
    if (other.number == own_.number && regions.region_of[triangle] == region) return;
    const auto& [a, b, c] = regions.triangles[triangle];
    const auto hit = meet_triangle(start, direction, regions.points[a], regions.points[b], regions.points[c]);
    if (!hit || hit->along < behind || hit->along > reach) return;
    if (first && hit->along >= first->along) {
      const bool is_before = first->placed == other.number && triangle < first->triangle;
      if (hit->along > first->along || !is_before) return;
    }
    // A transform that mirrors turns triangles over, and the ray with them.
    const bool leaves = hit->leaves != (placed.outside == Outside::back);
    // What faces the same way in the same plane lies beside it, not over it.
    if (leaves && hit->along <= tolerance_) return;
    first = First{hit->along, other.number, triangle, leaves};
    ray.most = hit->along;
    other.last = triangle;
  };
  if (other.last) meet(*other.last);
  regions.tree.visit(ray, tolerance_ * placed.shrink, meet);
}

std::optional<RegionCover> Surroundings::over(uint32_t region, const glm::dvec3& from, const glm::dvec3& way,
                                              double whole) {
  const double near = whole / 16;
  Box around{from, from};
  around.extend(from + way * near);
  std::optional<First> first;
  for (Other& other : others_) {
    if (overlap(other.box, around)) look(other, region, from, way, near, first);
  }
  if (first) return RegionCover{first->placed, std::max(first->along, 0.0)};
  for (Other& other : others_) {
    if (!other.is_body || !overlap(other.box, {from, from})) continue;
    first.reset();
    look(other, region, from, way, whole, first);
    if (first && first->leaves) return RegionCover{other.number, first->along};
  }
  return std::nullopt;
}

bool Surroundings::hidden_from_sides(uint32_t region, const glm::dvec3& from, const glm::dvec3& normal,
                                     double whole) {
  const glm::dvec3 other = std::abs(normal.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(normal, other)), v = glm::cross(normal, u);
  constexpr int ways = 8;
  constexpr double rise = 0.25;
  const double along = std::sqrt(1 - rise * rise);
  for (int i = 0; i < ways; ++i) {
    const double angle = 2 * std::numbers::pi * i / ways;
    const glm::dvec3 way = rise * normal + along * (std::cos(angle) * u + std::sin(angle) * v);
    if (!over(region, from, way, 4 * whole)) return false;
  }
  return true;
}

}  // namespace triptych
