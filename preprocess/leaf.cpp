#include "preprocess/leaf.hpp"

#include "base/progress.hpp"
#include "preprocess/cached_unit.hpp"
#include "preprocess/covered/error_gaps.hpp"
#include "preprocess/covered/leave_out.hpp"
#include "preprocess/pieces.hpp"
#include "simplify/level_normals.hpp"
#include "simplify/simplify.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <utility>

namespace triptych {

namespace {

/// What is known of a part's levels, beside their chunks and their geometry.
struct LevelFigures {
  std::vector<double> bounds;  ///< PartLevel::bound
  std::vector<double> grown;   ///< PartLevel::grown
  uint64_t detached_triangles = 0;
  bool stuck = false;
};

}  // namespace

template <>
inline constexpr auto record_members<LevelFigures> = std::tuple(&LevelFigures::bounds, &LevelFigures::grown,
                                                                &LevelFigures::detached_triangles,
                                                                &LevelFigures::stuck);

namespace {

constexpr size_t coarsest_triangles = 24;
/// Beyond this share of the part's diagonal a level shows nothing of the part's shape.
constexpr double coarsest_bound = 0.25;
constexpr double worth_it = 0.7;

constexpr size_t batch_parts = 4096;

/// The coarser level's points that are border points of the part, by their numbers there.
std::vector<BorderPoint> borders_of(const Piece& level, const std::vector<uint32_t>& numbers) {
  std::vector<BorderPoint> borders;
  if (numbers.empty()) return borders;
  for (uint32_t point = 0; point < level.sources.size(); ++point) {
    const uint32_t number = numbers[level.sources[point]];
    if (number != no_id) borders.push_back({point, number});
  }
  return borders;
}

/// A level on its way into the pack.
struct PartLevelGeometry {
  Part level;
  double bound = 0;  ///< PartLevel::bound
  double grown = 0;  ///< PartLevel::grown
};

/// Leaves out the triangles that are covered by no more than so many steps, if it has any; where all are, a
/// speck stays.
void leave_out_covered(Part& level, double distance) {
  const auto& triangles = level.surface.triangles;
  const auto goes = [&](const Triangle& triangle) { return is_left_out(triangle, distance); };
  if (std::ranges::none_of(triangles, goes)) return;
  if (std::ranges::all_of(triangles, goes)) {
    level = {speck(level.surface), {}, true};
    return;
  }
  std::vector<uint32_t> own(level.surface.points.size());
  std::iota(own.begin(), own.end(), 0u);
  Piece left = *without_covered({std::move(level.surface), std::move(own)}, distance);
  std::vector<uint32_t> numbers(left.sources.empty() ? 0 : *std::ranges::max_element(left.sources) + 1,
                                no_id);
  std::vector<BorderPoint> borders;
  for (uint32_t point = 0; point < left.sources.size(); ++point) numbers[left.sources[point]] = point;
  for (const BorderPoint& border : level.borders) {
    if (border.point < numbers.size() && numbers[border.point] != no_id)
      borders.push_back({numbers[border.point], border.number});
  }
  level = {std::move(left.surface), std::move(borders), true};
}

/// How many triangles of a level are covered, by class.
std::map<uint32_t, size_t> covered_by_class(const Surface& surface) {
  std::map<uint32_t, size_t> counts;
  for (const Triangle& triangle : surface.triangles) {
    if (covered_class(triangle.material) > 0) ++counts[covered_class(triangle.material)];
  }
  return counts;
}

/// Raises bounds beyond the part's gaps, and leaves out what is covered from there on. Where no level is off
/// by as much, further ones leave out what is worth it.
void keep_beneath(const PartInfo& info, std::vector<PartLevelGeometry>& levels) {
  if (info.gaps.empty()) return;
  std::vector<PartLevelGeometry> kept = {std::move(levels.front())};
  // moved: how far what is left may be from the source besides, and so from what it covers there.
  const auto add = [&](PartLevelGeometry level, double moved = 0) {
    constexpr double rounding = 1 + 1e-9;
    level.bound = beyond_gaps(level.bound, info.gaps);
    const double leaves_out = level.bound;
    level.bound = beyond_gaps(level.bound + moved, info.gaps);
    if (!info.covered.empty()) leave_out_covered(level.level, rounding * leaves_out / info.covered_step);
    // Of levels with one bound the coarsest is enough.
    if (kept.size() > 1 && kept.back().bound >= level.bound) kept.pop_back();
    kept.push_back(std::move(level));
  };
  for (size_t i = 1; i < levels.size(); ++i) add(std::move(levels[i]));
  if (!info.covered.empty()) {
    const PartLevelGeometry last = kept.back();
    size_t left = last.level.surface.triangles.size(), goes = 0;
    const auto counts = covered_by_class(last.level.surface);
    for (const auto& [of_class, count] : counts) {
      goes += count;
      const bool pays = static_cast<double>(left - goes) <= worth_it * static_cast<double>(left);
      if (!pays && of_class != counts.rbegin()->first) continue;
      const double from = distance_of_class(of_class) * info.covered_step;
      if (from > kept.back().bound) add({last.level, from, last.grown}, last.bound);
      left -= std::exchange(goes, 0);
    }
  }
  levels = std::move(kept);
}

/// Where the runs of a part's triangles end.
std::vector<uint32_t> run_ends(const PartInfo& info) {
  std::vector<uint32_t> ends;
  for (const PartRun& run : info.runs) ends.push_back((ends.empty() ? 0 : ends.back()) + run.triangles);
  return ends;
}

/// What make_levels() makes its result of.
void write_levels_key(ContentKeyWriter& key, std::span<const std::byte> part, const PartInfo& info,
                      const Lattice& lattice, Palette palette, const BuildOptions& options,
                      size_t kept_triangles) {
  write_unit_kind(key, UnitKind::part_levels, options);
  key.write(uint64_t{part.size()});
  key.write_all(part);
  key.write(lattice.step);
  key.write(uint64_t{kept_triangles});
  key.write(info.moved);
  key.write(info.covered_step);
  key.write(info.variant_of == no_id);
  key.write(info.transparent);
  if (info.transparent) key.write_all(std::span<const uint32_t>(seen_through_colors(palette)));
  for (const PartRun& run : info.runs) key.write(run.triangles);
  write_record(key, info.contacts);
  write_record(key, info.layers);
  write_record(key, info.covered);
  write_record(key, info.gaps);
}

/// The unit UnitKind::part_levels: for each level a chunk, and its geometry where HLODs may begin with it.
UnitResult make_levels(Part part, const PartInfo& info, const Lattice& lattice, Palette palette,
                       const BuildOptions& options, size_t kept_triangles) {
  for (const CoveredTriangle& covered : info.covered) {
    uint32_t& material = part.surface.triangles[covered.triangle].material;
    material = material_covered(material, covered.of_class);
  }
  for (const LayeredTriangle& layered : info.layers) {
    uint32_t& material = part.surface.triangles[layered.triangle].material;
    material = material_in_layer(material, layered.layer);
  }
  std::vector<uint8_t> locked;
  std::vector<uint32_t> numbers;
  for (const uint32_t point : info.contacts) part.borders.push_back({point, 0});
  if (!part.borders.empty()) {
    locked.resize(part.surface.points.size(), 0);
    numbers.resize(part.surface.points.size(), no_id);
  }
  for (uint32_t i = 0; i < part.borders.size(); ++i) {
    locked[part.borders[i].point] = 1;
    numbers[part.borders[i].point] = part.borders[i].number = i;
  }
  const LatticeBox box = part.surface.box();
  SimplifyLimits limits = options.simplify_limits();
  limits.triangles = coarsest_triangles;
  limits.max_bound = coarsest_bound * glm::length(glm::dvec3(box.hi) - glm::dvec3(box.lo));
  Chain chain = simplify(part.surface, locked, limits);
  if (options.keep.shade || part.surface.file_normals) {
    LevelNormals normals(part.surface);
    for (Level& level : chain.levels) normals.shade(level.piece, level.bound);
  }

  UnitResult result;
  LevelFigures figures;
  figures.detached_triangles = chain.detached_triangles;
  figures.stuck = chain.stuck && chain.levels.empty();
  const double rounding = options.rules.bounds_hold_rounding ? lattice.rounding() : 0;
  std::vector<PartLevelGeometry> levels = {{std::move(part), info.moved * lattice.step + rounding, 0}};
  for (Level& level : chain.levels) {
    std::vector<BorderPoint> borders = borders_of(level.piece, numbers);
    levels.push_back({{std::move(level.piece.surface), std::move(borders)},
                      (level.bound + info.moved) * lattice.step + rounding,
                      level.moved * lattice.step});
  }
  keep_beneath(info, levels);
  for (size_t i = 0; i < levels.size(); ++i) {
    const auto& [level, bound, grown] = levels[i];
    // The other chain has the first one's chunk.
    if (i > 0 || info.variant_of == no_id) {
      EncodedChunk chunk = encode(level.surface, options.in_pieces(), info.transparent ? palette : Palette(),
                                  i == 0 ? run_ends(info) : std::vector<uint32_t>());
      chunk.seen_from_outside = level.seen_from_outside && options.rules.levels_are_marked;
      result.chunks.push_back({std::move(chunk), info.lattice});
    }
    const bool kept = i + 1 == levels.size() || level.surface.triangles.size() <= kept_triangles;
    result.geometry.push_back(kept ? record_bytes(level) : std::vector<std::byte>());
    figures.bounds.push_back(bound);
    figures.grown.push_back(grown);
  }
  result.figures = record_bytes(figures);
  return result;
}

/// `shared`: the finest level, where another chain has it already; null otherwise.
PartLevels take(const StoredUnit& stored, const PartLevel* shared, ImportReport& report) {
  const auto figures = stored.figures_as<LevelFigures>();
  report.repaired_edges += figures.detached_triangles;
  report.stuck_groups += figures.stuck;
  PartLevels levels{{}, stored.geometry};
  levels.levels.reserve(figures.bounds.size());
  if (shared) levels.levels.push_back(*shared);
  for (uint32_t i = 0; i < stored.chunks.size(); ++i) {
    const size_t level = levels.levels.size();
    levels.levels.push_back({stored.first_chunk + i, stored.chunks[i].triangle_count,
                             figures.bounds.at(level), figures.grown.at(level)});
  }
  return levels;
}

}  // namespace

std::vector<PartLevels> make_part_levels(const Parts& parts, const BuildOptions& options,
                                         size_t kept_triangles, BuildWork& work, ImportReport& report) {
  Progress progress("simplifying parts", parts.parts.size());
  const UnitFunction unit = [&](uint32_t part) {
    const PartInfo& info = parts.parts[part];
    const Lattice& lattice = parts.lattices[info.lattice];
    const std::vector<std::byte> bytes = work.parts().read(info.place);
    ContentKeyWriter key;
    if (options.cache)
      write_levels_key(key, bytes, info, lattice, parts.palette_view(), options, kept_triangles);
    return record_bytes(cached_unit(options.cache, "levels of parts", key, info.lattice, [&] {
      return make_levels(record_of<Part>(bytes, work.parts().path().string()), info, lattice,
                         parts.palette_view(), options, kept_triangles);
    }));
  };
  std::vector<uint32_t> all(parts.parts.size());
  std::iota(all.begin(), all.end(), 0u);
  std::vector<PartLevels> result;
  for (size_t first = 0; first < all.size();) {
    const size_t end = end_of_group(first, std::min(all.size(), first + batch_parts), unit_triangles(options),
                                    [&](size_t part) { return parts.parts[part].triangles; });
    work.run(
        UnitKind::part_levels, std::span(all).subspan(first, end - first), unit,
        [&](uint32_t part, const StoredUnit& stored) {
          const uint32_t other = parts.parts[part].variant_of;
          const PartLevel* shared = other == no_id ? nullptr : &result[other].levels.front();
          result.push_back(take(stored, shared, report));
        },
        &progress);
    first = end;
  }
  return result;
}

std::vector<LeafDrawable> leaf_drawables(const PlacedParts& parts, std::span<const PartLevels> levels,
                                         std::span<const uint32_t> members, size_t exit_triangles) {
  const auto error_of = [&](uint32_t member, uint32_t level) {
    const PlacedPart& placed = parts.placed[member];
    return levels[placed.part].levels[level].bound * parts.stretches[placed.transform];
  };
  /// Every member at its coarsest level within the threshold.
  const auto select = [&](double threshold) {
    LeafDrawable drawable;
    for (const uint32_t member : members) {
      const auto& choice = levels[parts.placed[member].part].levels;
      uint32_t level = 0;
      while (level + 1 < choice.size() && error_of(member, level + 1) <= threshold) ++level;
      drawable.levels.push_back(level);
      drawable.error = std::max(drawable.error, error_of(member, level));
      drawable.triangles += choice[level].triangles;
    }
    return drawable;
  };
  std::vector<double> errors;
  for (const uint32_t member : members) {
    for (uint32_t level = 1; level < levels[parts.placed[member].part].levels.size(); ++level) {
      errors.push_back(error_of(member, level));
    }
  }
  std::sort(errors.begin(), errors.end());
  std::vector<LeafDrawable> drawables = {select(-1)};
  for (double threshold = errors.empty() ? 0 : errors.front(); !errors.empty();) {
    if (drawables.back().triangles <= exit_triangles) break;
    LeafDrawable drawable = select(threshold);
    if (static_cast<double>(drawable.triangles) <=
        worth_it * static_cast<double>(drawables.back().triangles)) {
      drawables.push_back(std::move(drawable));
    }
    if (threshold >= errors.back()) break;
    const double next = *std::upper_bound(errors.begin(), errors.end(), threshold);
    threshold = std::min(std::max(2 * threshold, next), errors.back());
  }
  // HLODs begin with the last one: it has few triangles, or has every member at its coarsest level. The
  // geometry of other levels was not kept.
  if (drawables.back().triangles > exit_triangles && !errors.empty()) {
    LeafDrawable coarsest = select(errors.back());
    if (coarsest.levels != drawables.back().levels) drawables.push_back(std::move(coarsest));
  }
  return drawables;
}

}  // namespace triptych
