#include "preprocess/covered/find_covered.hpp"

#include "base/threads.hpp"
#include "preprocess/contacts/find_contacts.hpp"
#include "preprocess/part_space.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
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

  /// What a placement may be covered by: in an order and with a key that are the same for placements among
  /// the same others.
  struct Neighborhood {
    std::vector<uint32_t> placed;
    std::vector<int64_t> key;
  };
  Neighborhood neighborhood(uint32_t number) const {
    const Box box = grown(boxes_[number], diagonal(boxes_[number]) / 16 + tolerance_);
    const PartSpace own(hierarchy_, number);
    std::vector<std::pair<std::array<int64_t, 13>, uint32_t>> entries;
    tree_.visit(box, [&](uint32_t other) {
      const Affine& transform = hierarchy_.transforms[hierarchy_.placed[other].transform];
      std::array<int64_t, 13> entry{part_of(other)};
      // Axes to a millionth, places to a quarter of the tolerance.
      for (int column = 0; column < 4; ++column) {
        const glm::dvec3 relative = column < 3 ? own.inverse * transform[column] : own.in(transform[3]);
        const double unit = column < 3 ? 1e-6 : tolerance_ / 4;
        for (int row = 0; row < 3; ++row)
          entry[static_cast<size_t>(1 + 3 * column + row)] = std::llround(relative[row] / unit);
      }
      entries.push_back({entry, other});
    });
    std::sort(entries.begin(), entries.end());
    Neighborhood result;
    for (const auto& [entry, other] : entries) {
      result.placed.push_back(other);
      result.key.insert(result.key.end(), entry.begin(), entry.end());
    }
    return result;
  }

  /// All placements of one part.
  std::vector<CoveredRegion> look_at(const std::vector<uint32_t>& placements) const {
    struct Looked {
      Neighborhood around;
      uint32_t like = 0;           ///< the first placement with this neighborhood
      std::vector<Covers> covers;  ///< by region that is left; empty where another one is alike
    };
    std::vector<Looked> looked;
    std::map<std::vector<int64_t>, uint32_t> known;  // by key, index of the first placement
    std::vector<uint32_t> left;
    for (uint32_t k = 0; k < placements.size(); ++k) {
      Looked& here = looked.emplace_back(Looked{neighborhood(placements[k]), k, {}});
      const auto [first, is_new] = known.try_emplace(here.around.key, k);
      here.like = first->second;
      if (!is_new) continue;
      Others others;
      for (const uint32_t other : here.around.placed)
        others.push_back({other, grown(boxes_[other], tolerance_)});
      const Placed own(parts_, hierarchy_, placements[k], cache_);
      if (k == 0) {
        left.resize(own.regions->regions.size());
        std::iota(left.begin(), left.end(), 0u);
      }
      std::vector<size_t> kept;
      for (size_t i = 0; i < left.size(); ++i) {
        auto found = covers_of(own, left[i], others);
        if (!found) continue;
        kept.push_back(i);
        here.covers.push_back(std::move(*found));
      }
      if (kept.size() < left.size()) {
        for (uint32_t before = 0; before < k; ++before) {
          if (looked[before].like == before) looked[before].covers = only(looked[before].covers, kept);
        }
        left = only(left, kept);
      }
      if (left.empty()) return {};
    }
    std::vector<CoveredRegion> result;
    for (uint32_t k = 0; k < placements.size(); ++k) {
      const Looked& like = looked[looked[k].like];
      for (size_t i = 0; i < left.size(); ++i) {
        Covers covers = like.covers[i];
        for (CoveredRegion::Cover& cover : covers) {  // the same ones around this placement
          const auto& around = like.around.placed;
          const auto at = std::find(around.begin(), around.end(), cover.placed) - around.begin();
          cover.placed = looked[k].around.placed.at(static_cast<size_t>(at));
        }
        std::ranges::sort(covers, {}, &CoveredRegion::Cover::placed);
        result.push_back({placements[k], placements[looked[k].like], left[i], std::move(covers)});
      }
    }
    return result;
  }

  template <typename Value>
  static std::vector<Value> only(std::vector<Value>& values, const std::vector<size_t>& kept) {
    std::vector<Value> result;
    for (const size_t index : kept) result.push_back(std::move(values[index]));
    return result;
  }

  /// Nothing where the region is not covered all over.
  std::optional<Covers> covers_of(const Placed& own, uint32_t index, Others& others) const {
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
        const auto over = first_over(own, index, at, normal, whole, others);
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
    const auto look = [&](Other& other, const Box& way, double reach) {
      const uint32_t number = other.number;
      const Placed& placed = loaded(other);
      placed.regions->tree.visit(grown(placed.in(way), tolerance_ * placed.shrink), [&](uint32_t triangle) {
        if (number == own.number && placed.regions->region_of[triangle] == region) return;
        const auto corners = placed.corners(triangle);
        const auto hit = meet(from, normal, corners[0], corners[1], corners[2]);
        if (!hit || hit->along < -tolerance_ || hit->along > reach) return;
        if (first && hit->along >= first->along) return;
        const bool leaves = hit->leaves != placed.turns_over;
        // What faces the same way in the same plane lies beside it, not over it.
        if (!leaves || hit->along > tolerance_) first = First{hit->along, number, leaves};
      });
    };
    const double near = whole / 16;
    Box way{from, from};
    way.extend(from + normal * near);
    for (Other& other : others) {
      if (overlap(other.box, way)) look(other, way, near);
    }
    if (first) return CoveredRegion::Cover{first->placed, std::max(first->along, 0.0)};
    way.extend(from + normal * whole);
    std::optional<CoveredRegion::Cover> inside;
    for (Other& other : others) {
      const PartInfo& info = parts_.parts[part_of(other.number)];
      if (other.number == own.number || info.outside == Outside::none || info.borders > 0 ||
          !overlap(other.box, {from, from}))
        continue;
      first.reset();
      look(other, way, whole);
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
