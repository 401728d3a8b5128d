#include "preprocess/covered/make_room.hpp"

#include "preprocess/covered/error_gaps.hpp"
#include "preprocess/covered/region_distances.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace triptych {

namespace {

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
    const std::map<uint32_t, RegionClasses> classes =
        region_classes(parts_, hierarchy, covered, cache_, kept_);
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

  Parts& parts_;
  const PlacedCache& kept_;
  PartCache<PartRegions> cache_;
};

}  // namespace

CoveredReport make_room(Parts& parts, const SpoolFile& geometry, uint64_t memory, const PlacedCache& kept) {
  return RoomMaker(parts, geometry, memory, kept).run();
}

}  // namespace triptych
