#include "preprocess/covered/find_covered.hpp"

#include "base/threads.hpp"
#include "preprocess/contacts/find_contacts.hpp"
#include "preprocess/covered/relative_place.hpp"
#include "preprocess/covered/surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

namespace triptych {

namespace {

/// Places on a triangle: n(n + 1)/2 of them, n of 2 or more, all inside. False as soon as take(place) is.
template <typename Take>
bool each_sample(const std::array<glm::dvec3, 3>& corners, int n, const Take& take) {
  constexpr double inset = 0.01;
  const double scale = (1 - 3 * inset) / (n - 1), start = inset;
  for (int i = 0; i < n; ++i) {
    for (int k = 0; i + k < n; ++k) {
      const double u = start + scale * i, v = start + scale * k;
      if (!take(corners[0] * (1 - u - v) + corners[1] * u + corners[2] * v)) return false;
    }
  }
  return true;
}

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
  using Covers = std::vector<RegionCover>;

  static std::vector<Box> boxes_of(const Parts& parts, const PlacedParts& hierarchy) {
    std::vector<Box> boxes;
    for (const LatticeBox& box : hierarchy.boxes) boxes.push_back(parts.lattices[hierarchy.lattice].box(box));
    return boxes;
  }
  uint32_t part_of(uint32_t placed) const { return hierarchy_.placed[placed].part; }

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
    std::ranges::sort(covers, {}, &RegionCover::placed);
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
  class Looker {
   public:
    Looker(const CoveredFinder& finder, uint32_t placed)
        : finder_(finder), number_(placed), around_(finder.neighborhood(placed)) {}

    /// Nothing where the region is not covered all over. New ways in which it is go to the proofs.
    std::optional<Covers> covers_of(uint32_t region, std::vector<Proof>& proofs) {
      for (const Proof& proof : proofs) {
        if (auto covers = covers_by(proof, around_)) return covers;
      }
      if (!surroundings_) {
        std::vector<std::pair<uint32_t, Box>> others;
        for (const auto& [place, other] : around_.placed) others.push_back({other, finder_.boxes_[other]});
        surroundings_.emplace(finder_.parts_, finder_.hierarchy_, finder_.cache_, number_, others,
                              finder_.tolerance_);
      }
      auto covers = finder_.look_over(*surroundings_, region);
      constexpr size_t most_proofs = 16;
      if (covers && proofs.size() < most_proofs) {
        Proof& proof = proofs.emplace_back();
        for (const RegionCover& cover : *covers) {
          const RelativePlace place =
              relative_place(surroundings_->own(), finder_.hierarchy_, cover.placed, finder_.tolerance_);
          proof.covers.push_back({place, cover.clearance});
        }
      }
      return covers;
    }

   private:
    const CoveredFinder& finder_;
    uint32_t number_;
    Neighborhood around_;
    std::optional<Surroundings> surroundings_;
  };

  /// Samples a region all over; nothing where it is not covered.
  std::optional<Covers> look_over(Surroundings& surroundings, uint32_t index) const {
    const PlacedRegions& own = surroundings.own();
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
        const auto over = surroundings.over(index, at, normal, whole);
        if (!over) return false;
        const auto [entry, inserted] = nearest.try_emplace(over->placed, over->clearance);
        if (!inserted) entry->second = std::min(entry->second, over->clearance);
        return !is_corner || surroundings.hidden_from_sides(index, at, normal, whole);
      });
      if (!all) return std::nullopt;
    }
    Covers covers;
    for (const auto& [placed, clearance] : nearest) covers.push_back({placed, clearance});
    return covers;
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
