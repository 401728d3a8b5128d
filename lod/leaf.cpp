#include "lod/leaf.hpp"

#include "base/progress.hpp"
#include "base/threads.hpp"
#include "lod/encoded.hpp"
#include "lod/simplify.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace triptych {

namespace {

constexpr size_t coarsest_triangles = 24;
/// Beyond this share of the part's diagonal a level shows nothing of the part's shape.
constexpr double coarsest_bound = 0.25;
constexpr double worth_it = 0.7;

struct Prepared {
  std::vector<EncodedChunk> chunks;
  std::vector<double> bounds;  ///< lattice steps
  std::vector<Part> surfaces;
  size_t detached_triangles = 0;
  bool stuck = false;
};

Prepared prepare(Part& part, size_t kept_triangles) {
  Prepared prepared;
  prepared.chunks.push_back(encode(part.surface));
  prepared.bounds.push_back(0);
  std::vector<uint8_t> locked;
  for (const uint32_t border : part.borders) locked.push_back(border != no_border);
  const LatticeBox box = part.surface.box();
  SimplifyLimits limits;
  limits.triangles = coarsest_triangles + static_cast<size_t>(std::count(locked.begin(), locked.end(), 1));
  limits.largest_bound = coarsest_bound * glm::length(glm::dvec3(box.hi) - glm::dvec3(box.lo));
  Chain chain = simplify(part.surface, locked, limits);
  prepared.detached_triangles = chain.detached_triangles;
  prepared.stuck = chain.stuck && chain.levels.empty();
  std::vector<uint32_t> borders = part.borders;
  prepared.surfaces.push_back(std::move(part));
  for (Level& level : chain.levels) {
    prepared.chunks.push_back(encode(level.piece.surface));
    prepared.bounds.push_back(level.bound);
    Part& coarser = prepared.surfaces.emplace_back();
    coarser.lattice = prepared.surfaces[0].lattice;
    if (!borders.empty()) {
      for (const uint32_t source : level.piece.sources) coarser.borders.push_back(borders[source]);
    }
    coarser.surface = std::move(level.piece.surface);
  }
  for (size_t i = 0; i + 1 < prepared.surfaces.size(); ++i) {
    if (prepared.surfaces[i].surface.triangles.size() > kept_triangles) prepared.surfaces[i] = {};
  }
  part = {{}, {}, prepared.surfaces.back().lattice};
  return prepared;
}

}  // namespace

std::vector<PartLevels> make_part_levels(Parts& parts, size_t kept_triangles, PackWriter& writer,
                                         ImportReport& report) {
  constexpr size_t batch = 512;  // encoded chunks wait in memory for their turn
  Progress progress("simplifying parts", parts.parts.size());
  std::vector<PartLevels> result(parts.parts.size());
  for (size_t first = 0; first < result.size(); first += batch) {
    std::vector<Prepared> prepared(std::min(batch, result.size() - first));
    parallel_for(prepared.size(), [&](size_t i) {
      prepared[i] = prepare(parts.parts[first + i], kept_triangles);
      progress.advance();
    });
    for (size_t i = 0; i < prepared.size(); ++i) {
      const uint32_t lattice = parts.parts[first + i].lattice;
      PartLevels& levels = result[first + i];
      for (size_t level = 0; level < prepared[i].chunks.size(); ++level) {
        const EncodedChunk& chunk = prepared[i].chunks[level];
        const double bound =
            prepared[i].bounds[level] * parts.lattices[lattice].step + parts.lattices[lattice].rounding();
        levels.levels.push_back({append(writer, chunk, lattice), chunk.triangles, bound});
      }
      levels.surfaces = std::move(prepared[i].surfaces);
      report.repaired_edges += prepared[i].detached_triangles;
      report.stuck_groups += prepared[i].stuck;
    }
  }
  return result;
}

std::vector<LeafDrawable> leaf_drawables(const Parts& parts, std::span<const PartLevels> levels,
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
  // HLODs begin with the last one: it has few triangles, or every member at its coarsest. Others were not
  // kept.
  if (drawables.back().triangles > exit_triangles && !errors.empty()) {
    LeafDrawable coarsest = select(errors.back());
    if (coarsest.levels != drawables.back().levels) drawables.push_back(std::move(coarsest));
  }
  return drawables;
}

}  // namespace triptych
