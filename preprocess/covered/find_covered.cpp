#include "preprocess/covered/find_covered.hpp"

#include "base/threads.hpp"
#include "preprocess/contacts/find_contacts.hpp"
#include "preprocess/covered/relative_place.hpp"
#include "preprocess/part_space.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>

namespace triptych {

namespace {

/// Where a ray meets a triangle.
struct Hit {
  double along = 0;
  bool leaves = false;  ///< it passes the triangle from its back to its front
};

/// Moeller and Trumbore, Fast, minimum storage ray/triangle intersection, 1997. Hit::along: in lengths of the
/// direction.
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

class CoveredFinder {
 public:
  CoveredFinder(const Parts& parts, const PlacedParts& hierarchy, PartCache<PartRegions>& cache)
      : parts_(parts),
        hierarchy_(hierarchy),
        cache_(cache),
        tolerance_(contact_steps * parts.lattices[hierarchy.lattice].step),
        boxes_(boxes_of(parts, hierarchy)),
        tree_(boxes_) {}

  std::vector<CoveredRegion> run() {
    // Part by part: a region that is not covered in one placement is not looked at in others.
    std::map<uint32_t, std::vector<uint32_t>> placements;
    for (uint32_t i = 0; i < hierarchy_.placed.size(); ++i) {
      if (parts_.parts[part_of(i)].outside != Outside::none) placements[part_of(i)].push_back(i);
    }
    std::vector<std::pair<uint32_t, const std::vector<uint32_t>*>> list;
    for (const auto& [part, own] : placements) list.push_back({part, &own});
    std::vector<std::vector<CoveredRegion>> found(list.size());
    parallel_for(list.size(), [&](size_t i) { found[i] = look_at(*list[i].second); });
    std::vector<CoveredRegion> result;
    for (auto& own : found) {
      for (CoveredRegion& region : own) result.push_back(std::move(region));
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

  /// Placed parts near the one that is looked at, and itself; loaded where they are needed.
  struct Other {
    uint32_t number;
    Box box;
    std::optional<Placed> placed = {};
  };
  using Others = std::vector<Other>;

  const Placed& loaded(Other& other) const {
    if (!other.placed) other.placed.emplace(parts_, hierarchy_, other.number, cache_);
    return *other.placed;
  }

  /// What a placement may be covered by, by how it stands to it.
  struct Neighborhood {
    std::vector<std::pair<RelativePlace, uint32_t>> placed;  // ascending

    std::optional<uint32_t> at(const RelativePlace& place) const {
      const auto found =
          std::ranges::lower_bound(placed, place, {}, &std::pair<RelativePlace, uint32_t>::first);
      if (found == placed.end() || found->first != place) return std::nullopt;
      return found->second;
    }
  };
  Neighborhood neighborhood(uint32_t number) const {
    const Box box = grown(boxes_[number], diagonal(boxes_[number]) / 16 + tolerance_);
    const PartSpace own(hierarchy_, number);
    Neighborhood result;
    tree_.visit(box, [&](uint32_t other) {
      result.placed.push_back({relative_place(own, hierarchy_, other, tolerance_), other});
    });
    std::sort(result.placed.begin(), result.placed.end());
    return result;
  }

  /// What was found to cover a region in one placement; it does so wherever all of it stands around.
  struct Proof {
    std::vector<std::pair<RelativePlace, double>> covers;  // with clearances
  };
  static std::optional<Covers> covers_by(const Proof& proof, const Neighborhood& around) {
    Covers covers;
    for (const auto& [place, clearance] : proof.covers) {
      const auto placed = around.at(place);
      if (!placed) return std::nullopt;
      covers.push_back({*placed, clearance});
    }
    std::ranges::sort(covers, {}, &CoveredRegion::Cover::placed);
    return covers;
  }

  /// All placements of one part.
  std::vector<CoveredRegion> look_at(const std::vector<uint32_t>& placements) const {
    const auto regions = cache_.get(part_of(placements.front()));
    std::vector<uint32_t> left(regions->regions.size());
    std::iota(left.begin(), left.end(), 0u);
    std::vector<std::vector<Proof>> proofs(left.size());
    std::vector<std::vector<Covers>> covers(placements.size());  // by region
    for (size_t k = 0; k < placements.size() && !left.empty(); ++k) {
      Looker looker(*this, placements[k]);
      covers[k].resize(proofs.size());
      std::erase_if(left, [&](uint32_t region) {
        auto found = looker.covers_of(region, proofs[region]);
        if (found) covers[k][region] = std::move(*found);
        return !found;
      });
    }
    std::vector<CoveredRegion> result;
    for (size_t k = 0; k < placements.size() && !left.empty(); ++k) {
      for (const uint32_t region : left)
        result.push_back({placements[k], region, std::move(covers[k][region])});
    }
    return result;
  }

  /// A placement among what stands around it, which is loaded where it is needed.
  struct Looker {
    Looker(const CoveredFinder& of, uint32_t placed)
        : finder(of), number(placed), around(of.neighborhood(placed)) {}

    /// Nothing where the region is not covered all over. New ways in which it is go to the proofs.
    std::optional<Covers> covers_of(uint32_t region, std::vector<Proof>& proofs) {
      for (const Proof& proof : proofs) {
        if (auto covers = covers_by(proof, around)) return covers;
      }
      if (!own) {
        for (const auto& [place, other] : around.placed)
          others.push_back({other, grown(finder.boxes_[other], finder.tolerance_)});
        own.emplace(finder.parts_, finder.hierarchy_, number, finder.cache_);
      }
      auto covers = finder.covers_of(*own, region, others);
      constexpr size_t most_proofs = 16;
      if (covers && proofs.size() < most_proofs) {
        Proof& proof = proofs.emplace_back();
        for (const CoveredRegion::Cover& cover : *covers) {
          proof.covers.push_back(
              {relative_place(*own, finder.hierarchy_, cover.placed, finder.tolerance_), cover.clearance});
        }
      }
      return covers;
    }

    const CoveredFinder& finder;
    uint32_t number;
    Neighborhood around;
    Others others = {};
    std::optional<Placed> own = {};
  };

  /// Nothing where the region is not covered all over.
  std::optional<Covers> covers_of(const Placed& own, uint32_t index, Others& others) const {
    const SmoothRegion& region = own.regions->regions[index];
    const double size = diagonal(own.out(region.box));
    if (size < 8 * tolerance_) return std::nullopt;
    // How large the surface is of which a border cut off a corner is not known: it may lie deeper than the
    // corner alone might, where it is hidden from the sides, too.
    const double least = region.is_cut ? own.regions->diagonal / own.shrink / 4 : 0;
    const bool is_corner = size < least;
    const double whole = std::max(size, least);
    const double apart = size / 12;  // wider triangles have more samples
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
      const int n = std::clamp(static_cast<int>(std::ceil(longest / apart)), 2, 8);
      const bool all = each_sample(corners, n, [&](const glm::dvec3& at) {
        const auto over = first_over(own, index, at, normal, whole, others);
        if (!over) return false;
        const auto [entry, inserted] = nearest.try_emplace(over->placed, over->clearance);
        if (!inserted) entry->second = std::min(entry->second, over->clearance);
        return !is_corner || hidden_from_sides(own, index, at, normal, whole, others);
      });
      if (!all) return std::nullopt;
    }
    Covers covers;
    for (const auto& [placed, clearance] : nearest) covers.push_back({placed, clearance});
    return covers;
  }

  /// Whether rays that rise by a quarter of their length meet something, too.
  bool hidden_from_sides(const Placed& own, uint32_t region, const glm::dvec3& from, const glm::dvec3& normal,
                         double whole, Others& others) const {
    const glm::dvec3 other = std::abs(normal.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(normal, other)), v = glm::cross(normal, u);
    constexpr int ways = 8;
    constexpr double rise = 0.25;
    const double along = std::sqrt(1 - rise * rise);
    for (int i = 0; i < ways; ++i) {
      const double angle = 2 * std::numbers::pi * i / ways;
      const glm::dvec3 way = rise * normal + along * (std::cos(angle) * u + std::sin(angle) * v);
      if (!first_over(own, region, from, way, 4 * whole, others)) return false;
    }
    return true;
  }

  /// What covers the place, if anything does: something near, or a body that it lies in.
  std::optional<CoveredRegion::Cover> first_over(const Placed& own, uint32_t region, const glm::dvec3& from,
                                                 const glm::dvec3& normal, double whole,
                                                 Others& others) const {
    struct First {
      double along;
      uint32_t placed;
      bool leaves;
    };
    std::optional<First> first;
    const auto look = [&](Other& other, double reach) {
      const uint32_t number = other.number;
      const Placed& placed = loaded(other);
      const PartRegions& regions = *placed.regions;
      // In the other's own space, where lengths along the ray are the same.
      const glm::dvec3 start = placed.in(from), way = placed.inverse * normal;
      RaySpan ray(start, way, -tolerance_, reach);
      regions.tree.visit(ray, tolerance_ * placed.shrink, [&](uint32_t triangle) {
        if (number == own.number && regions.region_of[triangle] == region) return;
        const auto& [a, b, c] = regions.triangles[triangle];
        const auto hit = meet(start, way, regions.points[a], regions.points[b], regions.points[c]);
        if (!hit || hit->along < -tolerance_ || hit->along > reach) return;
        if (first && hit->along >= first->along) return;
        // A transform that mirrors turns triangles over, and the ray with them.
        const bool leaves = hit->leaves != (placed.outside == Outside::back);
        // What faces the same way in the same plane lies beside it, not over it.
        if (leaves && hit->along <= tolerance_) return;
        first = First{hit->along, number, leaves};
        ray.most = hit->along;
      });
    };
    const double near = whole / 16;
    Box way{from, from};
    way.extend(from + normal * near);
    for (Other& other : others) {
      if (overlap(other.box, way)) look(other, near);
    }
    if (first) return CoveredRegion::Cover{first->placed, std::max(first->along, 0.0)};
    std::optional<CoveredRegion::Cover> inside;
    for (Other& other : others) {
      const PartInfo& info = parts_.parts[part_of(other.number)];
      if (other.number == own.number || info.outside == Outside::none || info.borders > 0 ||
          !overlap(other.box, {from, from}))
        continue;
      first.reset();
      look(other, whole);
      if (first && first->leaves) {
        inside = {other.number, first->along};
        break;
      }
    }
    return inside;
  }

  const Parts& parts_;
  const PlacedParts& hierarchy_;
  PartCache<PartRegions>& cache_;
  double tolerance_;
  std::vector<Box> boxes_;  ///< of placed parts
  BoxTree tree_;
};

}  // namespace

std::vector<CoveredRegion> find_covered(const Parts& parts, const PlacedParts& hierarchy,
                                        PartCache<PartRegions>& regions) {
  return CoveredFinder(parts, hierarchy, regions).run();
}

}  // namespace triptych
