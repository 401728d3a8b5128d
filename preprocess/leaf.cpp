#include "preprocess/leaf.hpp"

#include "base/inject.hpp"
#include "base/progress.hpp"
#include "base/threads.hpp"
#include "preprocess/pieces.hpp"
#include "simplify/simplify.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace triptych {

namespace {

constexpr size_t coarsest_triangles = 24;
/// Beyond this share of the part's diagonal a level shows nothing of the part's shape.
constexpr double coarsest_bound = 0.25;
constexpr double worth_it = 0.7;

constexpr size_t unit_parts = 4096;

/// A part's levels before they have their places in the files.
struct Prepared {
  std::vector<EncodedChunk> chunks;  ///< for each level
  std::vector<double> bounds;        ///< lattice steps
  std::vector<Part> kept;            ///< for each level its geometry, or nothing
  uint64_t detached_triangles = 0;
  bool stuck = false;
};

Prepared prepare(Part part, const BuildOptions& options, size_t kept_triangles) {
  Prepared prepared;
  const bool in_pieces = options.in_pieces();
  prepared.chunks.push_back(encode(part.surface, in_pieces));
  prepared.bounds.push_back(0);
  constexpr uint32_t none = 0xffffffffu;
  std::vector<uint8_t> locked;
  std::vector<uint32_t> numbers;
  if (!part.borders.empty()) {
    locked.resize(part.surface.points.size(), 0);
    numbers.resize(part.surface.points.size(), none);
  }
  for (uint32_t i = 0; i < part.borders.size(); ++i) {
    locked[part.borders[i].point] = 1;
    numbers[part.borders[i].point] = part.borders[i].number = i;
  }
  const LatticeBox box = part.surface.box();
  SimplifyLimits limits = options.simplify;
  limits.triangles = coarsest_triangles;
  limits.largest_bound = coarsest_bound * glm::length(glm::dvec3(box.hi) - glm::dvec3(box.lo));
  Chain chain = simplify(part.surface, locked, limits);
  prepared.detached_triangles = chain.detached_triangles;
  prepared.stuck = chain.stuck && chain.levels.empty();
  const auto keep = [&](Part& level, bool last) {
    const bool small = level.surface.triangles.size() <= kept_triangles;
    prepared.kept.push_back(small || last ? std::move(level) : Part{});
  };
  keep(part, chain.levels.empty());
  for (Level& level : chain.levels) {
    prepared.chunks.push_back(encode(level.piece.surface, in_pieces));
    prepared.bounds.push_back(level.bound);
    Part coarser;
    if (!numbers.empty()) {
      for (uint32_t point = 0; point < level.piece.sources.size(); ++point) {
        const uint32_t number = numbers[level.piece.sources[point]];
        if (number != none) coarser.borders.push_back({point, number});
      }
    }
    coarser.surface = std::move(level.piece.surface);
    keep(coarser, &level == &chain.levels.back());
  }
  return prepared;
}

void put(ByteWriter& record, const Prepared& prepared, const Lattice& lattice, const PartInfo& info,
         BuildWork& work) {
  record.write(prepared.detached_triangles);
  record.write(uint64_t{prepared.stuck});
  record.write(uint64_t{prepared.chunks.size()});
  for (size_t level = 0; level < prepared.chunks.size(); ++level) {
    const double bound = (prepared.bounds[level] + info.moved) * lattice.step +
                         (injected(Fault::uncounted_lattice) ? 0 : lattice.rounding());
    const EncodedChunk& chunk = prepared.chunks[level];
    record.write(PartLevel{work.pack().add_chunk(chunk, info.lattice), chunk.triangles, bound});
    const Part& kept = prepared.kept[level];
    record.write(kept.surface.triangles.empty() ? SpoolPlace{} : store(work.surfaces(), kept));
  }
}

PartLevels take(ByteReader& record, ImportReport& report) {
  PartLevels levels;
  report.repaired_edges += record.read<uint64_t>();
  report.stuck_groups += record.read<uint64_t>();
  auto count = record.read<uint64_t>();
  levels.levels.reserve(count);
  levels.surfaces.reserve(count);
  for (; count > 0; --count) {
    levels.levels.push_back(record.read<PartLevel>());
    levels.surfaces.push_back(record.read<SpoolPlace>());
  }
  return levels;
}

}  // namespace

std::vector<PartLevels> make_part_levels(const Parts& parts, const BuildOptions& options,
                                         size_t kept_triangles, BuildWork& work, ImportReport& report) {
  Progress progress("simplifying parts", parts.parts.size());
  const uint64_t most = unit_triangles(options);
  std::vector<PartLevels> result;
  for (size_t first = 0; first < parts.parts.size();) {
    const size_t end = end_of_group(first, std::min(parts.parts.size(), first + unit_parts), most,
                                    [&](size_t part) { return parts.parts[part].triangles; });
    work.unit(
        [&](ByteWriter& record) {
          std::vector<Prepared> prepared(end - first);
          parallel_for(prepared.size(), [&](size_t i) {
            const SpoolPlace& place = parts.parts[first + i].place;
            prepared[i] = prepare(load_part(work.parts(), place), options, kept_triangles);
            progress.advance();
          });
          for (size_t i = 0; i < prepared.size(); ++i) {
            const PartInfo& info = parts.parts[first + i];
            put(record, prepared[i], parts.lattices[info.lattice], info, work);
          }
        },
        [&](ByteReader& record) {
          for (size_t i = first; i < end; ++i) result.push_back(take(record, report));
        });
    first = end;
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
