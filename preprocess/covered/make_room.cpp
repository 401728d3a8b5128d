#include "preprocess/covered/make_room.hpp"

#include "base/threads.hpp"
#include "preprocess/covered/find_covered.hpp"
#include "simplify/distance.hpp"

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
  RoomMaker(Parts& parts, const SpoolFile& geometry, const BuildRules& rules, uint64_t memory)
      : parts_(parts), geometry_(geometry), rules_(rules), cache_(parts, geometry, memory) {}

  CoverReport run() {
    for (PlacedParts& hierarchy : parts_.hierarchies) look_into(hierarchy);
    CoverReport report;
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
    std::map<uint32_t, std::set<uint32_t>> triangles;  // by part
    for (const auto& [placed, own] : covered) {
      const uint32_t part = hierarchy.placed[placed].part;
      if (triangles.count(part) > 0) continue;
      const auto all = cache_.get(part);
      for (const uint32_t index : own.regions) {
        const SmoothRegion& region = all->regions[index];
        for (uint32_t i = region.first; i < region.first + region.count; ++i)
          triangles[part].insert(all->numbers[i]);
      }
    }
    std::vector<std::pair<uint32_t, const CoveredPart*>> list;
    for (const auto& [placed, own] : covered) list.push_back({placed, &own});
    std::vector<double> distances(list.size());  // lattice steps
    parallel_for(list.size(),
                 [&](size_t i) { distances[i] = distance_of(list[i].first, hierarchy, covered, triangles); });
    std::map<uint32_t, double> furthest;  // by part
    for (size_t i = 0; i < list.size(); ++i) {
      double& distance = furthest[hierarchy.placed[list[i].first].part];
      distance = std::max(distance, distances[i]);
    }
    const Lattice& lattice = parts_.lattices[hierarchy.lattice];
    for (const auto& [part, distance] : furthest) {
      if (!(distance < no_distance)) continue;
      PartInfo& info = parts_.parts[part];
      info.covered.assign(triangles[part].begin(), triangles[part].end());
      info.covered_class = class_of_distance(distance);
    }
    for (const auto& [placed, own] : list) {
      const PartInfo& info = parts_.parts[hierarchy.placed[placed].part];
      if (info.covered.empty()) continue;
      const double high = distance_of_class(info.covered_class) * lattice.step;
      for (const auto& [cover, clearance] : own->covers) {
        const ErrorGap gap{std::min(std::max(0.49 * clearance, least_room * high), high), high};
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

  /// A bound of the distance of a placed part's covered triangles from what is not covered: of itself, of
  /// what covers it, and of what covers that. Lattice steps.
  double distance_of(uint32_t placed, const PlacedParts& hierarchy,
                     const std::map<uint32_t, CoveredPart>& covered,
                     const std::map<uint32_t, std::set<uint32_t>>& triangles) const {
    std::set<uint32_t> near = {placed};
    for (int step = 0; step < 2; ++step) {
      const std::set<uint32_t> before = near;
      for (const uint32_t part : before) {
        const auto found = covered.find(part);
        if (found == covered.end()) continue;
        for (const auto& [cover, clearance] : found->second.covers) near.insert(cover);
      }
    }
    const Lattice& lattice = parts_.lattices[hierarchy.lattice];
    Baker all(lattice, {}, rules_), left(lattice, {}, rules_);
    for (const uint32_t member : near) {
      const uint32_t part = hierarchy.placed[member].part;
      const auto gone = triangles.find(part);
      const auto surface = load<Part>(geometry_, parts_.parts[part].place).surface;
      Surface own = surface, other = surface;
      own.colors.clear(), other.colors.clear();
      own.triangles.clear(), other.triangles.clear();
      for (uint32_t i = 0; i < surface.triangles.size(); ++i) {
        const bool is_gone = gone != triangles.end() && gone->second.count(i) > 0;
        if (is_gone && member == placed) own.triangles.push_back(surface.triangles[i]);
        if (!is_gone) other.triangles.push_back(surface.triangles[i]);
      }
      add(own, hierarchy.placed[member], hierarchy, all);
      add(other, hierarchy.placed[member], hierarchy, all);
      add(other, hierarchy.placed[member], hierarchy, left);
    }
    const Baked whole = all.finish(0), rest = left.finish(0);
    if (rest.surface.triangles.empty()) return no_distance;
    const double moved = (whole.error + rest.error) / lattice.step;
    const double distance = distance_bound(whole.surface, rest.surface, Colors::ignore) + moved;
    const LatticeBox& box = hierarchy.boxes[placed];
    return distance <= thin * diagonal(lattice.box(box)) / lattice.step ? distance : no_distance;
  }

  void add(const Surface& surface, const PlacedPart& placed, const PlacedParts& hierarchy,
           Baker& baker) const {
    if (surface.triangles.empty()) return;
    const Piece used = extract(surface.points, surface.triangles);
    const std::vector<LeafSpan> none(used.surface.points.size());
    if (placed.transform == 0) {
      baker.add(used.surface, none);
    } else {
      baker.add(used.surface, parts_.lattices[parts_.parts[placed.part].lattice],
                hierarchy.transforms[placed.transform], none);
    }
  }

  Parts& parts_;
  const SpoolFile& geometry_;
  const BuildRules& rules_;
  PartCache<PartRegions> cache_;
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

CoverReport make_room(Parts& parts, const SpoolFile& geometry, const BuildRules& rules, uint64_t memory) {
  return RoomMaker(parts, geometry, rules, memory).run();
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
  Surface speck{.points = {at, at + glm::ivec3(1, 0, 0), at + glm::ivec3(0, 1, 0)},
                .triangles = {{{0, 1, 2}, first.material}}};
  if (!surface.colors.empty()) speck.colors = {surface.colors.front()};
  return speck;
}

}  // namespace triptych
