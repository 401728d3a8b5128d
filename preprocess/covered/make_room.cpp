#include "preprocess/covered/make_room.hpp"

#include "base/threads.hpp"
#include "preprocess/contacts/find_contacts.hpp"
#include "preprocess/covered/find_covered.hpp"
#include "preprocess/covered/relative_place.hpp"
#include "preprocess/part_space.hpp"
#include "preprocess/spatial_order.hpp"
#include "simplify/one_sided.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace triptych {

namespace {

/// The covered regions of a placed part, and what covers each.
using CoveredPart = std::map<uint32_t, std::vector<RegionCover>>;
using CoveredParts = std::map<uint32_t, CoveredPart>;  // by placed part

class RoomMaker {
 public:
  RoomMaker(Parts& parts, const SpoolFile& geometry, uint64_t memory, const PlacedCache& kept)
      : parts_(parts), kept_(kept), cache_(parts, geometry, memory) {}

  CoveredReport run() {
    for (PlacedParts& hierarchy : parts_.hierarchies) look_into(hierarchy);
    CoveredReport report;
    for (PartInfo& part : parts_.parts) {
      join_gaps(part.gaps);
      report.triangles += part.covered.size();
      report.parts += !part.gaps.empty();
    }
    return report;
  }

 private:
  /// Beyond this share of a covered part's diagonal it is no thin layer.
  static constexpr double thin = 1.0 / 8;
  /// Where surfaces touch, levels that are off by less than this share of the distance are as good as exact.
  static constexpr double least_room = 1.0 / 32;

  /// Of the clearance between a covered surface and what covers it, what each of them may be off by. The one
  /// that shows gets more of it.
  static constexpr double covered_share = 0.45, cover_share = 0.45;

  void look_into(PlacedParts& hierarchy) {
    CoveredParts covered;
    for (CoveredRegion& region : find_covered(parts_, hierarchy, cache_, kept_))
      covered[region.placed][region.region] = std::move(region.covers);
    if (covered.empty()) return;
    const std::map<uint32_t, RegionClasses> classes = classes_of(hierarchy, covered);
    for (const auto& [part, of_regions] : classes) {
      const auto regions = cache_.get(part);
      for (uint32_t i = 0; i < regions->triangles.size(); ++i) {
        const auto found = of_regions.find(regions->region_of[i]);
        if (found != of_regions.end())
          parts_.parts[part].covered.push_back({regions->numbers[i], found->second});
      }
    }
    const double step = parts_.lattices[hierarchy.lattice].step;
    for (const auto& [placed, own] : covered) {
      const PlacedPart& of = hierarchy.placed[placed];
      PartInfo& info = parts_.parts[of.part];
      if (info.covered.empty()) continue;
      info.covered_step = std::max(info.covered_step, step / hierarchy.stretches[of.transform]);
      for (const auto& [region, of_class] : classes.at(of.part))
        keep_apart(hierarchy, placed, own.at(region), distance_of_class(of_class) * step);
    }
  }

  /// Tells the parts that a covered region and what covers it may not be off by more than there is room,
  /// before the region is left out. distance: from which on that is so.
  void keep_apart(const PlacedParts& hierarchy, uint32_t placed, const std::vector<RegionCover>& covers,
                  double distance) {
    for (const RegionCover& cover : covers) {
      for (const auto& [side, share] :
           {std::pair(placed, covered_share), std::pair(cover.placed, cover_share)}) {
        const double low = std::min(std::max(share * cover.clearance, least_room * distance), distance);
        const PlacedPart& of = hierarchy.placed[side];
        const double scale = 1 / hierarchy.stretches[of.transform];
        add_gap({low * scale, distance * scale}, parts_.parts[of.part].gaps);
      }
    }
  }

  /// The classes of the covered regions of each part, by region; of those that levels leave out.
  using RegionClasses = std::map<uint32_t, uint32_t>;
  std::map<uint32_t, RegionClasses> classes_of(const PlacedParts& hierarchy, const CoveredParts& covered) {
    // One of those that stand alike to what covers them.
    std::map<std::vector<RelativePlace>, uint32_t> alike;
    for (const auto& [placed, own] : covered) {
      const PartSpace space(hierarchy, placed);
      const auto place_of = [&](uint32_t other) {
        return relative_place(space, hierarchy, other, contact_tolerance(hierarchy));
      };
      std::vector<RelativePlace> places;
      for (const uint32_t member : near_covers(placed, hierarchy, covered))
        places.push_back(place_of(member));
      std::ranges::sort(places);
      places.push_back(place_of(placed));
      alike.try_emplace(std::move(places), placed);
    }
    std::vector<uint32_t> different, list;
    std::vector<Box> boxes;
    for (const auto& [places, placed] : alike) {
      different.push_back(placed);
      boxes.push_back(parts_.lattices[hierarchy.lattice].box(hierarchy.boxes[placed]));
    }
    for (const uint32_t index : spatial_order(boxes)) list.push_back(different[index]);
    std::vector<std::map<uint32_t, double>> distances(list.size());
    parallel_for(list.size(), [&](size_t i) { distances[i] = kept_distances(list[i], hierarchy, covered); });
    std::map<uint32_t, std::map<uint32_t, double>> furthest;
    for (size_t i = 0; i < list.size(); ++i) {
      for (const auto& [region, distance] : distances[i]) {
        double& of_region = furthest[hierarchy.placed[list[i]].part][region];
        of_region = std::max(of_region, distance);
      }
    }
    std::map<uint32_t, RegionClasses> classes;
    for (const auto& [part, of_regions] : furthest) {
      for (const auto& [region, distance] : of_regions) {
        if (distance < no_distance) classes[part][region] = class_of_distance(distance);
      }
    }
    return classes;
  }

  static constexpr double no_distance = 1e300;

  struct RegionDistance {
    uint64_t region = 0;
    double distance = 0;
  };

  double contact_tolerance(const PlacedParts& hierarchy) const {
    return contact_steps * parts_.lattices[hierarchy.lattice].step;
  }

  /// A placed part, what covers it, and what covers that.
  static std::set<uint32_t> with_covers(uint32_t placed, const CoveredParts& covered) {
    std::set<uint32_t> near = {placed};
    for (int step = 0; step < 2; ++step) {
      const std::set<uint32_t> before = near;
      for (const uint32_t part : before) {
        const auto found = covered.find(part);
        if (found == covered.end()) continue;
        for (const auto& [region, covers] : found->second) {
          for (const RegionCover& cover : covers) near.insert(cover.placed);
        }
      }
    }
    return near;
  }

  /// with_covers(), without those that are further away than any distance counts.
  std::vector<uint32_t> near_covers(uint32_t placed, const PlacedParts& hierarchy,
                                    const CoveredParts& covered) const {
    const Lattice& lattice = parts_.lattices[hierarchy.lattice];
    const Box box = lattice.box(hierarchy.boxes[placed]), near = grown(box, thin * diagonal(box));
    std::vector<uint32_t> members;
    for (const uint32_t member : with_covers(placed, covered)) {
      if (member == placed || overlap(lattice.box(hierarchy.boxes[member]), near)) members.push_back(member);
    }
    return members;
  }

  /// distances_of(), or what it gave.
  std::map<uint32_t, double> kept_distances(uint32_t placed, const PlacedParts& hierarchy,
                                            const CoveredParts& covered) const {
    if (!kept_.is_used()) return distances_of(placed, hierarchy, covered);
    ContentKeyWriter key;
    kept_.begin(key, "distances of what is covered", hierarchy);
    for (const uint32_t member : near_covers(placed, hierarchy, covered)) {
      kept_.add(key, hierarchy, member);
      key.write(member == placed);
      const auto found = covered.find(member);
      key.write(uint64_t{found == covered.end() ? 0 : found->second.size()});
      if (found == covered.end()) continue;
      for (const auto& [region, covers] : found->second) key.write(region);
    }
    const auto distances = kept_.get<std::vector<RegionDistance>>(key, [&] {
      std::vector<RegionDistance> list;
      for (const auto& [region, distance] : distances_of(placed, hierarchy, covered))
        list.push_back({region, distance});
      return list;
    });
    std::map<uint32_t, double> result;
    for (const RegionDistance& of : distances) result[static_cast<uint32_t>(of.region)] = of.distance;
    return result;
  }

  /// For each covered region of a placed part a bound of its distance from what is not covered: of the part
  /// itself, of what covers it, and of what covers that. Lattice steps; no_distance where that is far.
  std::map<uint32_t, double> distances_of(uint32_t placed, const PlacedParts& hierarchy,
                                          const CoveredParts& covered) const {
    const Lattice& lattice = parts_.lattices[hierarchy.lattice];
    const Box box = lattice.box(hierarchy.boxes[placed]);
    const double most = thin * diagonal(box) / lattice.step;
    std::map<uint32_t, std::vector<Corners>> left_out;
    std::vector<Corners> stays;
    for (const uint32_t member : near_covers(placed, hierarchy, covered)) {
      const auto regions = cache_.get(hierarchy.placed[member].part);
      const auto found = covered.find(member);
      const PartSpace space(hierarchy, member);
      for (uint32_t i = 0; i < regions->triangles.size(); ++i) {
        const uint32_t region = regions->region_of[i];
        const bool is_covered = found != covered.end() && found->second.count(region) > 0;
        if (is_covered && member != placed) continue;
        Corners corners;
        Box around;
        for (size_t k = 0; k < 3; ++k) {
          corners[k] = space.out(regions->points[regions->triangles[i][k]]);
          around.extend(corners[k]);
          corners[k] /= lattice.step;
        }
        if (is_covered) {
          left_out[region].push_back(corners);
        } else if (overlap(around, grown(box, most * lattice.step))) {
          stays.push_back(corners);
        }
      }
    }
    std::map<uint32_t, double> distances;
    for (const auto& [region, triangles] : left_out) distances[region] = no_distance;
    if (stays.empty()) return distances;
    const TriangleTree tree(std::move(stays));
    for (const auto& [region, triangles] : left_out) distances[region] = distance(triangles, tree, most);
    return distances;
  }

  /// A bound of the triangles' distance from those of the tree; no_distance above `most`.
  static double distance(const std::vector<Corners>& triangles, const TriangleTree& tree, double most) {
    constexpr double tightness = 1.25;
    constexpr size_t cuts_per_triangle = 4, cuts_beyond = 12;
    OneSided side(tree, 0, tightness);
    for (const Corners& corners : triangles) {
      for (const glm::dvec3& corner : corners) side.reach(corner);
      if (side.lower() > most) return no_distance;
    }
    for (const Corners& corners : triangles) {
      side.add(corners, no_distance);
      if (side.lower() > most) return no_distance;
    }
    const double found = side.finish(cuts_per_triangle * triangles.size() + cuts_beyond, no_distance, most);
    // Placements that stand among the same others do so to within the tolerance of contacts.
    return found < most ? found + contact_steps : no_distance;
  }

  Parts& parts_;
  const PlacedCache& kept_;
  mutable PartCache<PartRegions> cache_;
};

}  // namespace

CoveredReport make_room(Parts& parts, const SpoolFile& geometry, uint64_t memory, const PlacedCache& kept) {
  return RoomMaker(parts, geometry, memory, kept).run();
}

}  // namespace triptych
