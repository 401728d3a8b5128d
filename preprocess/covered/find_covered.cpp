#include "preprocess/covered/find_covered.hpp"

#include "base/threads.hpp"
#include "preprocess/contacts/find_contacts.hpp"
#include "preprocess/part_space.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace triptych {

namespace {

/// Where a ray meets a triangle.
struct Hit {
  double along = 0;
  bool leaves = false;  ///< it passes the triangle from its back to its front
};

/// Moeller and Trumbore, Fast, minimum storage ray/triangle intersection, 1997. direction: of length 1.
std::optional<Hit> meet(const glm::dvec3& from, const glm::dvec3& direction, const glm::dvec3& a,
                        const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 ab = b - a, ac = c - a, p = glm::cross(direction, ac);
  const double determinant = glm::dot(ab, p);
  if (determinant == 0) return std::nullopt;
  const glm::dvec3 to = from - a;
  const double u = glm::dot(to, p) / determinant;
  const glm::dvec3 q = glm::cross(to, ab);
  const double v = glm::dot(direction, q) / determinant;
  constexpr double edge = 1e-9;  // no ray passes between two triangles
  if (u < -edge || v < -edge || u + v > 1 + edge) return std::nullopt;
  return Hit{glm::dot(ac, q) / determinant, determinant < 0};
}

/// Places on a triangle: n(n + 1)/2 of them, all inside. False as soon as take(place) is.
template <typename Take>
bool each_sample(const std::array<glm::dvec3, 3>& corners, int n, const Take& take) {
  constexpr double inset = 0.01;
  const double scale = n > 1 ? (1 - 3 * inset) / (n - 1) : 0, start = n > 1 ? inset : 1.0 / 3;
  for (int i = 0; i < n; ++i) {
    for (int k = 0; i + k < n; ++k) {
      const double u = start + scale * i, v = start + scale * k;
      if (!take(corners[0] * (1 - u - v) + corners[1] * u + corners[2] * v)) return false;
    }
  }
  return true;
}

/// A placed part in the space of its hierarchy.
struct Placed : PartSpace {
  Placed(const Parts& parts, const PlacedParts& hierarchy, uint32_t index, PartCache<PartRegions>& cache)
      : PartSpace(hierarchy, index),
        number(index),
        outside(parts.parts[hierarchy.placed[index].part].outside),
        turns_over((glm::determinant(glm::dmat3(transform)) < 0) != (outside == Outside::back)),
        regions(cache.get(hierarchy.placed[index].part)) {}

  std::array<glm::dvec3, 3> corners(uint32_t triangle) const {
    std::array<glm::dvec3, 3> result;
    for (size_t k = 0; k < 3; ++k) result[k] = out(regions->points[regions->triangles[triangle][k]]);
    return result;
  }

  uint32_t number;
  Outside outside;
  bool turns_over;  ///< triangles go round clockwise where they look out, or may do so
  std::shared_ptr<const PartRegions> regions;
};

class CoverFinder {
 public:
  CoverFinder(const Parts& parts, const PlacedParts& hierarchy, PartCache<PartRegions>& cache)
      : parts_(parts),
        hierarchy_(hierarchy),
        cache_(cache),
        tolerance_(contact_steps * parts.lattices[hierarchy.lattice].step),
        tree_(boxes_of(parts, hierarchy)) {}

  std::vector<CoveredRegion> run() {
    std::vector<std::vector<CoveredRegion>> found(hierarchy_.placed.size());
    parallel_for(found.size(), [&](size_t i) { look_at(static_cast<uint32_t>(i), found[i]); });
    // A region counts if it is covered in all of the part's placements.
    std::vector<uint32_t> placements(parts_.parts.size(), 0);
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> times;
    for (const PlacedPart& placed : hierarchy_.placed) ++placements[placed.part];
    for (const auto& own : found) {
      for (const CoveredRegion& region : own) ++times[{part_of(region.placed), region.region}];
    }
    std::vector<CoveredRegion> result;
    for (auto& own : found) {
      for (CoveredRegion& region : own) {
        const uint32_t part = part_of(region.placed);
        if (times[{part, region.region}] == placements[part]) result.push_back(std::move(region));
      }
    }
    return result;
  }

 private:
  using Covers = std::vector<CoveredRegion::Cover>;

  static std::vector<Box> boxes_of(const Parts& parts, const PlacedParts& hierarchy) {
    std::vector<Box> boxes;
    for (const LatticeBox& box : hierarchy.boxes) boxes.push_back(parts.lattices[hierarchy.lattice].box(box));
    return boxes;
  }
  uint32_t part_of(uint32_t placed) const { return hierarchy_.placed[placed].part; }

  void look_at(uint32_t number, std::vector<CoveredRegion>& found) const {
    if (parts_.parts[part_of(number)].outside == Outside::none) return;
    const Placed own(parts_, hierarchy_, number, cache_);
    for (uint32_t region = 0; region < own.regions->regions.size(); ++region) {
      if (auto covers = covers_of(own, region)) found.push_back({number, region, std::move(*covers)});
    }
  }

  /// Nothing where the region is not covered all over.
  std::optional<Covers> covers_of(const Placed& own, uint32_t index) const {
    const SmoothRegion& region = own.regions->regions[index];
    const double whole = diagonal(own.out(region.box));
    if (whole < 8 * tolerance_) return std::nullopt;
    const double apart = whole / 12;  // wider triangles have more samples
    std::map<uint32_t, double> nearest;
    for (uint32_t i = region.first; i < region.first + region.count; ++i) {
      const auto corners = own.corners(i);
      glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
      const double length = glm::length(normal);
      if (!(length > 0)) continue;
      normal *= (own.turns_over ? -1 : 1) / length;
      double longest = 0;
      for (size_t k = 0; k < 3; ++k)
        longest = std::max(longest, glm::distance(corners[k], corners[(k + 1) % 3]));
      const int least = region.count < 64 ? 2 : 1;
      const int n = std::clamp(static_cast<int>(std::ceil(longest / apart)), least, 8);
      const bool all = each_sample(corners, n, [&](const glm::dvec3& at) {
        const auto over = first_over(own, index, at, normal, whole);
        if (!over) return false;
        const auto [entry, inserted] = nearest.try_emplace(over->placed, over->clearance);
        if (!inserted) entry->second = std::min(entry->second, over->clearance);
        return true;
      });
      if (!all) return std::nullopt;
    }
    Covers covers;
    for (const auto& [placed, clearance] : nearest) covers.push_back({placed, clearance});
    return covers;
  }

  /// What covers the place, if anything does.
  std::optional<CoveredRegion::Cover> first_over(const Placed& own, uint32_t region, const glm::dvec3& from,
                                                 const glm::dvec3& normal, double whole) const {
    const double near = whole / 32;
    Box way{from, from};
    way.extend(from + normal * whole);
    double first = whole;
    std::optional<CoveredRegion::Cover> cover;
    tree_.visit(grown(way, tolerance_), [&](uint32_t number) {
      const Placed other(parts_, hierarchy_, number, cache_);
      other.regions->tree.visit(grown(other.in(way), tolerance_ * other.shrink), [&](uint32_t triangle) {
        if (number == own.number && other.regions->region_of[triangle] == region) return;
        const auto corners = other.corners(triangle);
        const auto hit = meet(from, normal, corners[0], corners[1], corners[2]);
        if (!hit || hit->along < -tolerance_ || hit->along > first) return;
        const bool leaves = hit->leaves != other.turns_over;
        // What faces the same way in the same plane lies beside it, not over it.
        if (leaves && hit->along <= tolerance_) return;
        first = hit->along;
        const bool covers = first <= near || (leaves && other.outside != Outside::none);
        cover.reset();
        if (covers) cover = {number, std::max(first, 0.0)};
      });
    });
    return cover;
  }

  const Parts& parts_;
  const PlacedParts& hierarchy_;
  PartCache<PartRegions>& cache_;
  double tolerance_;
  BoxTree tree_;  ///< of placed parts
};

}  // namespace

std::vector<CoveredRegion> find_covered(const Parts& parts, const PlacedParts& hierarchy,
                                        PartCache<PartRegions>& regions) {
  return CoverFinder(parts, hierarchy, regions).run();
}

}  // namespace triptych
