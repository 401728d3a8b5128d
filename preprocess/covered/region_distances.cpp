#include "preprocess/covered/region_distances.hpp"

#include "base/threads.hpp"
#include "preprocess/contacts/find_contacts.hpp"
#include "preprocess/covered/error_gaps.hpp"
#include "preprocess/covered/relative_place.hpp"
#include "preprocess/part_space.hpp"
#include "preprocess/spatial_order.hpp"
#include "simplify/one_sided.hpp"

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>

namespace triptych {

namespace {

/// Beyond this share of a covered part's diagonal it is no thin layer.
constexpr double thin = 1.0 / 8;
/// How much larger a bound may be than a distance that is known to occur.
constexpr double tightness = 1.25;
/// Of what lies too far to be left out.
constexpr double no_distance = 1e300;

struct RegionDistance {
  uint64_t region = 0;
  double distance = 0;
};

/// What a build keeps of a placement.
struct KeptDistances {
  ContentKey neighbours, triangles;  ///< of all that they were made of, and of that what counts
  std::vector<RegionDistance> distances;
};

}  // namespace

template <>
inline constexpr auto record_members<KeptDistances> = std::tuple(&KeptDistances::neighbours,
                                                                 &KeptDistances::triangles,
                                                                 &KeptDistances::distances);

namespace {

/// Of each covered region of a part the furthest in the placements that were looked at, lattice steps.
using Furthest = std::map<uint32_t, double>;

class RegionMeter {
 public:
  RegionMeter(const Parts& parts, const PlacedParts& hierarchy, const CoveredParts& covered,
              PartCache<PartRegions>& cache, const PlacedCache& kept)
      : hierarchy_(hierarchy),
        lattice_(parts.lattices[hierarchy.lattice]),
        covered_(covered),
        cache_(cache),
        kept_(kept) {}

  std::map<uint32_t, RegionClasses> run() const {
    const auto different = different_placements();
    std::vector<const std::vector<Placement>*> list;
    std::vector<Box> firsts;
    for (const auto& [part, placements] : different) {
      list.push_back(&placements);
      firsts.push_back(lattice_.box(hierarchy_.boxes[placements.front().placed]));
    }
    std::vector<Furthest> found(list.size());
    const std::vector<uint32_t> order = spatial_order(firsts);
    parallel_for(list.size(), [&](size_t i) {
      for (const Placement& placement : *list[order[i]])
        found[order[i]] = kept_further(placement, found[order[i]]);
    });
    std::map<uint32_t, RegionClasses> classes;
    size_t index = 0;
    for (const auto& [part, placements] : different) {
      for (const auto& [region, distance] : found[index]) {
        // Placements that stand among the same others do so to within the tolerance of contacts.
        if (distance < no_distance) classes[part][region] = class_of_distance(distance + contact_steps);
      }
      ++index;
    }
    return classes;
  }

 private:
  struct Placement {
    uint32_t placed = 0;
    std::vector<uint32_t> near;  ///< near_covers()
  };

  /// By part, one of those placements that stand alike to what covers them.
  std::map<uint32_t, std::vector<Placement>> different_placements() const {
    std::map<uint32_t, std::vector<Placement>> different;
    std::set<std::vector<RelativePlace>> seen;
    for (const auto& [placed, own] : covered_) {
      const PartSpace space(hierarchy_, placed);
      const auto place_of = [&](uint32_t other) {
        return relative_place(space, hierarchy_, other, contact_steps * lattice_.step);
      };
      Placement placement{placed, near_covers(placed)};
      std::vector<RelativePlace> places;
      for (const uint32_t member : placement.near) places.push_back(place_of(member));
      std::ranges::sort(places);
      places.push_back(place_of(placed));
      if (seen.insert(std::move(places)).second)
        different[hierarchy_.placed[placed].part].push_back(std::move(placement));
    }
    return different;
  }

  /// A placed part, what covers it, and what covers that: those that are no further away than any distance
  /// counts.
  std::vector<uint32_t> near_covers(uint32_t placed) const {
    std::set<uint32_t> all = {placed};
    for (int step = 0; step < 2; ++step) {
      const std::set<uint32_t> before = all;
      for (const uint32_t part : before) {
        const auto found = covered_.find(part);
        if (found == covered_.end()) continue;
        for (const auto& [region, covers] : found->second) {
          for (const RegionCover& cover : covers) all.insert(cover.placed);
        }
      }
    }
    const Box box = lattice_.box(hierarchy_.boxes[placed]), near = grown(box, thin * diagonal(box));
    std::vector<uint32_t> members;
    for (const uint32_t member : all) {
      if (member == placed || overlap(lattice_.box(hierarchy_.boxes[member]), near))
        members.push_back(member);
    }
    return members;
  }

  /// What distances of a placement's regions are measured of: their triangles, and those around them that are
  /// not covered; lattice steps.
  struct Measured {
    std::map<uint32_t, std::vector<Corners>> left_out;  ///< by region
    std::vector<Corners> stays;
    double most = 0;  ///< what is further counts as no distance
  };

  /// further(), or what it gave for the same neighbours, or else for the same triangles: most of what comes
  /// and goes around a placement, and most of what is covered elsewhere on its neighbours, is too far to
  /// matter.
  Furthest kept_further(const Placement& placement, const Furthest& before) const {
    if (!kept_.is_used()) return further(what_counts(placement, before), before);
    constexpr std::string_view what = "distances of what is covered";
    const ContentKey neighbours = neighbours_key(placement, before);
    ContentKeyWriter own;
    kept_.begin(own, what, hierarchy_);
    kept_.add(own, hierarchy_, placement.placed);
    KeptDistances known;
    kept_.renew(what, own, [&](const std::vector<std::byte>& bytes) {
      if (!bytes.empty()) known = record_of<KeptDistances>(bytes, "a build's cache");
      if (known.neighbours == neighbours) return bytes;
      const Measured measured = what_counts(placement, before);
      const ContentKey triangles = triangles_key(measured, before);
      if (known.triangles != triangles) {
        known.distances.clear();
        for (const auto& [region, distance] : further(measured, before))
          known.distances.push_back({region, distance});
      }
      known.neighbours = neighbours;
      known.triangles = triangles;
      return record_bytes(known);
    });
    Furthest result;
    for (const RegionDistance& of : known.distances) result[static_cast<uint32_t>(of.region)] = of.distance;
    return result;
  }

  static void write_distances(ContentKeyWriter& key, const Furthest& distances) {
    key.write(uint64_t{distances.size()});
    for (const auto& [region, distance] : distances) {
      key.write(region);
      key.write(distance);
    }
  }
  /// Of all that what_counts() looks at.
  ContentKey neighbours_key(const Placement& placement, const Furthest& before) const {
    ContentKeyWriter key;
    write_distances(key, before);
    for (const uint32_t member : placement.near) {
      kept_.add(key, hierarchy_, member);
      key.write(member == placement.placed);
      const auto found = covered_.find(member);
      key.write(uint64_t{found == covered_.end() ? 0 : found->second.size()});
      if (found == covered_.end()) continue;
      for (const auto& [region, covers] : found->second) key.write(region);
    }
    return key.key();
  }
  /// Of all that further() looks at.
  static ContentKey triangles_key(const Measured& measured, const Furthest& before) {
    ContentKeyWriter key;
    write_distances(key, before);
    for (const auto& [region, triangles] : measured.left_out) {
      key.write(region);
      key.write(uint64_t{triangles.size()});
      key.write_all(std::span<const Corners>(triangles));
    }
    key.write_all(std::span<const Corners>(measured.stays));
    key.write(measured.most);
    return key.key();
  }

  /// Of regions that are not known to be too far.
  Measured what_counts(const Placement& placement, const Furthest& before) const {
    const Box box = lattice_.box(hierarchy_.boxes[placement.placed]);
    Measured measured{{}, {}, thin * diagonal(box) / lattice_.step};
    Box around;
    {
      const auto regions = cache_.get(hierarchy_.placed[placement.placed].part);
      const PartSpace space(hierarchy_, placement.placed);
      for (const auto& [region, covers] : covered_.at(placement.placed)) {
        const auto known = before.find(region);
        if (known != before.end() && known->second == no_distance) continue;
        const SmoothRegion& of = regions->regions[region];
        std::vector<Corners>& triangles = measured.left_out[region];
        for (uint32_t i = of.first; i < of.first + of.count; ++i)
          triangles.push_back(corners_in_steps(*regions, space, i));
        around.extend(space.out(of.box));
      }
    }
    if (!measured.left_out.empty())
      measured.stays = what_stays(placement.near, grown(around, measured.most * lattice_.step));
    return measured;
  }

  /// `before`, and what is further in this placement.
  static Furthest further(const Measured& measured, const Furthest& before) {
    Furthest result = before;
    const auto& [left_out, stays, most] = measured;
    if (left_out.empty()) return result;
    if (stays.empty()) {
      for (const auto& [region, triangles] : left_out) result[region] = no_distance;
      return result;
    }
    const TriangleTree tree(stays);
    for (const auto& [region, triangles] : left_out) {
      double& distance = result[region];  // 0 where it was not met before
      distance = bound(triangles, tree, distance, most);
    }
    return result;
  }

  Corners corners_in_steps(const PartRegions& regions, const PartSpace& space, uint32_t triangle) const {
    Corners corners;
    for (size_t k = 0; k < 3; ++k)
      corners[k] = space.out(regions.points[regions.triangles[triangle][k]]) / lattice_.step;
    return corners;
  }

  /// Of these placed parts the triangles that are not covered, as far as they reach into the box.
  std::vector<Corners> what_stays(const std::vector<uint32_t>& members, const Box& box) const {
    std::vector<Corners> stays;
    for (const uint32_t member : members) {
      if (!overlap(lattice_.box(hierarchy_.boxes[member]), box)) continue;
      const auto regions = cache_.get(hierarchy_.placed[member].part);
      const PartSpace space(hierarchy_, member);
      const auto covered = covered_.find(member);
      regions->tree.visit(space.in(box), [&](uint32_t triangle) {
        if (covered == covered_.end() || covered->second.count(regions->region_of[triangle]) == 0)
          stays.push_back(corners_in_steps(*regions, space, triangle));
      });
    }
    return stays;
  }

  /// A bound of how far any of the triangles is from those of the tree, and of `known`; no_distance above
  /// `most`.
  static double bound(const std::vector<Corners>& triangles, const TriangleTree& tree, double known,
                      double most) {
    constexpr size_t cuts_per_triangle = 4, cuts_beyond = 12;
    OneSided side(tree, known / tightness, tightness);
    for (const Corners& corners : triangles) {
      for (const glm::dvec3& corner : corners) side.reach(corner);
      if (side.lower() > most) return no_distance;
    }
    for (const Corners& corners : triangles) {
      side.add(corners, no_distance);
      if (side.lower() > most) return no_distance;
    }
    const double found = side.finish(cuts_per_triangle * triangles.size() + cuts_beyond, no_distance, most);
    return found < most ? std::max(found, known) : no_distance;
  }

  const PlacedParts& hierarchy_;
  const Lattice& lattice_;
  const CoveredParts& covered_;
  PartCache<PartRegions>& cache_;
  const PlacedCache& kept_;
};

}  // namespace

std::map<uint32_t, RegionClasses> region_classes(const Parts& parts, const PlacedParts& hierarchy,
                                                 const CoveredParts& covered, PartCache<PartRegions>& cache,
                                                 const PlacedCache& kept) {
  return RegionMeter(parts, hierarchy, covered, cache, kept).run();
}

}  // namespace triptych
