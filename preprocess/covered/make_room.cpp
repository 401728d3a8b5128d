#include "preprocess/covered/make_room.hpp"

#include "base/threads.hpp"
#include "preprocess/contacts/find_contacts.hpp"
#include "preprocess/covered/find_covered.hpp"
#include "preprocess/covered/relative_place.hpp"
#include "preprocess/part_space.hpp"
#include "simplify/one_sided.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace triptych {

namespace {

/// For each placed part with covered regions those, and what covers them.
struct CoveredPart {
  std::vector<uint32_t> regions;
  std::map<uint32_t, double> covers;  ///< by placed part, the least clearance
};

class RoomMaker {
 public:
  RoomMaker(Parts& parts, const SpoolFile& geometry, uint64_t memory)
      : parts_(parts), cache_(parts, geometry, memory) {}

  CoveredReport run() {
    for (PlacedParts& hierarchy : parts_.hierarchies) look_into(hierarchy);
    CoveredReport report;
    for (const PartInfo& part : parts_.parts) {
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

  void look_into(PlacedParts& hierarchy) {
    std::map<uint32_t, CoveredPart> covered;  // by placed part
    for (const CoveredRegion& region : find_covered(parts_, hierarchy, cache_)) {
      CoveredPart& own = covered[region.placed];
      own.regions.push_back(region.region);
      for (const CoveredRegion::Cover& cover : region.covers) {
        const auto [known, inserted] = own.covers.try_emplace(cover.placed, cover.clearance);
        if (!inserted) known->second = std::min(known->second, cover.clearance);
      }
    }
    if (covered.empty()) return;
    // What is covered in one placement is so in all.
    std::map<uint32_t, std::vector<bool>> gone;  // by part, by region
    for (const auto& [placed, own] : covered) {
      const uint32_t part = hierarchy.placed[placed].part;
      if (gone.count(part) > 0) continue;
      std::vector<bool>& of_part = gone[part];
      of_part.resize(cache_.get(part)->regions.size());
      for (const uint32_t region : own.regions) of_part[region] = true;
    }
    // One of those that stand alike to what covers them.
    std::map<std::vector<RelativePlace>, uint32_t> alike;
    for (const auto& [placed, own] : covered) {
      const PartSpace space(hierarchy, placed);
      std::vector<RelativePlace> places;
      for (const uint32_t member : with_covers(placed, covered))
        places.push_back(relative_place(space, hierarchy, member, contact_tolerance(hierarchy)));
      std::ranges::sort(places);
      alike.try_emplace(std::move(places), placed);
    }
    std::vector<uint32_t> list;
    for (const auto& [places, placed] : alike) list.push_back(placed);
    std::vector<double> distances(list.size());  // lattice steps
    parallel_for(list.size(),
                 [&](size_t i) { distances[i] = distance_of(list[i], hierarchy, covered, gone); });
    std::map<uint32_t, double> furthest;  // by part
    for (size_t i = 0; i < list.size(); ++i) {
      double& distance = furthest[hierarchy.placed[list[i]].part];
      distance = std::max(distance, distances[i]);
    }
    const Lattice& lattice = parts_.lattices[hierarchy.lattice];
    for (const auto& [part, distance] : furthest) {
      if (!(distance < no_distance)) continue;
      PartInfo& info = parts_.parts[part];
      const auto regions = cache_.get(part);
      for (uint32_t i = 0; i < regions->triangles.size(); ++i) {
        if (gone[part][regions->region_of[i]]) info.covered.push_back(regions->numbers[i]);
      }
      info.covered_class = class_of_distance(distance);
    }
    for (const auto& [placed, own] : covered) {
      const PartInfo& info = parts_.parts[hierarchy.placed[placed].part];
      if (info.covered.empty()) continue;
      const double high = distance_of_class(info.covered_class) * lattice.step;
      for (const auto& [cover, clearance] : own.covers) {
        const ErrorGap gap{std::min(std::max(0.45 * clearance, least_room * high), high), high};
        for (const uint32_t side : {placed, cover}) {
          const PlacedPart& of = hierarchy.placed[side];
          add_gaps({gap}, 1 / hierarchy.stretches[of.transform], parts_.parts[of.part].gaps);
        }
      }
      const PlacedPart& of = hierarchy.placed[placed];
      double& from = parts_.parts[of.part].covered_from;
      from = std::max(from, high / hierarchy.stretches[of.transform]);
    }
  }

  static constexpr double no_distance = 1e300;

  double contact_tolerance(const PlacedParts& hierarchy) const {
    return contact_steps * parts_.lattices[hierarchy.lattice].step;
  }

  /// A placed part, what covers it, and what covers that.
  static std::set<uint32_t> with_covers(uint32_t placed, const std::map<uint32_t, CoveredPart>& covered) {
    std::set<uint32_t> near = {placed};
    for (int step = 0; step < 2; ++step) {
      const std::set<uint32_t> before = near;
      for (const uint32_t part : before) {
        const auto found = covered.find(part);
        if (found == covered.end()) continue;
        for (const auto& [cover, clearance] : found->second.covers) near.insert(cover);
      }
    }
    return near;
  }

  /// A bound of the distance of a placed part's covered triangles from what is not covered: of itself, of
  /// what covers it, and of what covers that. Lattice steps.
  double distance_of(uint32_t placed, const PlacedParts& hierarchy,
                     const std::map<uint32_t, CoveredPart>& covered,
                     const std::map<uint32_t, std::vector<bool>>& gone) const {
    const std::set<uint32_t> near = with_covers(placed, covered);
    const Lattice& lattice = parts_.lattices[hierarchy.lattice];
    const Box box = lattice.box(hierarchy.boxes[placed]);
    const double most = thin * diagonal(box);
    std::vector<Corners> left_out, stays;
    for (const uint32_t member : near) {
      const uint32_t part = hierarchy.placed[member].part;
      const auto regions = cache_.get(part);
      const auto found = gone.find(part);
      const PartSpace space(hierarchy, member);
      for (uint32_t i = 0; i < regions->triangles.size(); ++i) {
        const bool is_gone = found != gone.end() && found->second[regions->region_of[i]];
        if (is_gone && member != placed) continue;
        Corners corners;
        Box around;
        for (size_t k = 0; k < 3; ++k) {
          corners[k] = space.out(regions->points[regions->triangles[i][k]]);
          around.extend(corners[k]);
          corners[k] /= lattice.step;
        }
        if (is_gone) {
          left_out.push_back(corners);
        } else if (overlap(around, grown(box, most))) {
          stays.push_back(corners);
        }
      }
    }
    if (stays.empty()) return no_distance;
    constexpr double tightness = 1.5;
    constexpr size_t cuts_per_triangle = 6, cuts_beyond = 2000;
    const TriangleTree tree(std::move(stays));
    OneSided side(tree, 0, tightness);
    for (const Corners& corners : left_out) {
      for (const glm::dvec3& corner : corners) side.reach(corner);
      if (side.lower() * lattice.step > most) return no_distance;
    }
    for (const Corners& corners : left_out) side.add(corners, no_distance);
    const double distance = side.finish(cuts_per_triangle * left_out.size() + cuts_beyond, no_distance);
    // Placements that stand among the same others do so to within the tolerance of contacts.
    return distance * lattice.step < most ? distance + contact_steps : no_distance;
  }

  Parts& parts_;
  mutable PartCache<PartRegions> cache_;
};

bool is_left_out(const Triangle& triangle, double distance) {
  const uint32_t of_class = covered_class(triangle.material);
  return of_class > 0 && distance_of_class(of_class) <= distance;
}

/// How many of the triangles are left out, and whether that is some of them.
bool leaves_out_some(const Surface& surface, double distance) {
  const auto count = std::ranges::count_if(
      surface.triangles, [&](const Triangle& triangle) { return is_left_out(triangle, distance); });
  return count > 0 && static_cast<size_t>(count) < surface.triangles.size();
}

}  // namespace

CoveredReport make_room(Parts& parts, const SpoolFile& geometry, uint64_t memory) {
  return RoomMaker(parts, geometry, memory).run();
}

std::optional<Piece> without_covered(const Piece& piece, double distance) {
  if (!leaves_out_some(piece.surface, distance)) return std::nullopt;
  std::vector<Triangle> triangles;
  std::vector<CornerColors> colors;
  for (size_t i = 0; i < piece.surface.triangles.size(); ++i) {
    if (is_left_out(piece.surface.triangles[i], distance)) continue;
    triangles.push_back(piece.surface.triangles[i]);
    if (!piece.surface.colors.empty()) colors.push_back(piece.surface.colors[i]);
  }
  Piece left = extract(piece.surface.points, triangles, colors);
  for (uint32_t& source : left.sources) source = piece.sources[source];
  return left;
}

double leave_out_covered(Baked& baked, double distance) {
  if (!leaves_out_some(baked.surface, distance)) return 0;
  double furthest = 0;
  for (const Triangle& triangle : baked.surface.triangles) {
    if (is_left_out(triangle, distance))
      furthest = std::max(furthest, distance_of_class(covered_class(triangle.material)));
  }
  Piece all{std::move(baked.surface), {}};
  for (uint32_t i = 0; i < all.surface.points.size(); ++i) all.sources.push_back(i);
  std::vector<SourceObjectId> objects;
  for (size_t i = 0; i < baked.objects.size(); ++i) {
    if (!is_left_out(all.surface.triangles[i], distance)) objects.push_back(baked.objects[i]);
  }
  Piece left = *without_covered(all, distance);
  std::vector<LeafSpan> spans;
  for (const uint32_t source : left.sources) spans.push_back(baked.spans[source]);
  baked.surface = std::move(left.surface);
  baked.spans = std::move(spans);
  baked.objects = std::move(objects);
  return furthest;
}

Surface speck(const Surface& surface) {
  const Triangle& first = surface.triangles.front();
  const glm::ivec3 at = surface.points[first.vertices[0]];
  // Along two axes in which it extends, so that it stays in the surface's box.
  const LatticeBox box = surface.box();
  Surface speck{.points = {at}, .triangles = {{{0, 1, 2}, first.material}}};
  for (int axis = 0; axis < 3 && speck.points.size() < 3; ++axis) {
    if (box.lo[axis] == box.hi[axis]) continue;
    speck.points.push_back(at);
    speck.points.back()[axis] += at[axis] < box.hi[axis] ? 1 : -1;
  }
  if (!surface.colors.empty()) speck.colors = {surface.colors.front()};
  return speck;
}

}  // namespace triptych
