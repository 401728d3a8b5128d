#include "simplify/collapse_chain.hpp"

#include "simplify/cover.hpp"
#include "simplify/layered_planes.hpp"
#include "simplify/moved_bound.hpp"
#include "simplify/reducer.hpp"
#include "simplify/vertex_clustering.hpp"

#include <algorithm>
#include <memory>
#include <numeric>
#include <optional>

namespace triptych {

namespace {

/// A level must have at most this share of the triangles of the one before it, or it is left out.
constexpr double worth_it = 0.75;
/// Halving the triangles about doubles the distance; where it grows by more than this factor, clustering may
/// be nearer.
constexpr double steep = 16;
/// The tightness of bounds where levels are measured quickly.
constexpr double hurried = 2;
/// The tightness where they are measured against the source.
constexpr double tight = 1.5;
/// Where cover takes more than this share of a bound, and the source has no more triangles than this, the
/// level is measured: that lies mostly on the other side of the source than what it lost. Not where colours
/// are ignored: there a smaller distance, to things of any colour, would bring in levels that show less.
constexpr double much = 0.3;
constexpr size_t quickly_measured = 2000;
/// A connected component is small if it has fewer triangles than this, and less than half of all.
constexpr size_t small_thing = 256;

/// Collapses do not take closed components below so many triangles.
constexpr size_t least_closed = 4;

/// Below how many triangles the surface is a heap: most of it are small components, collapses do not merge
/// them, and so they soon get stuck there, with a result that is no nearer than a clustering. A component
/// with a locked point is a piece of something larger.
size_t heap_below(const Surface& surface, std::span<const uint8_t> locked) {
  DisjointSets sets = connected_points(surface);
  std::vector<size_t> sizes(surface.points.size(), 0);
  for (const Triangle& triangle : surface.triangles) ++sizes[sets.root(triangle.vertices[0])];
  for (uint32_t i = 0; i < locked.size(); ++i) {
    if (locked[i]) sizes[sets.root(i)] = 0;
  }
  const size_t small = std::min(small_thing, surface.triangles.size() / 2);
  size_t in_small = 0, components = 0;
  for (const size_t size : sizes) {
    in_small += size < small ? size : 0;
    components += size > 0;
  }
  return 4 * in_small >= 3 * surface.triangles.size() ? least_closed * components : 0;
}

/// A level with its fast bound.
struct Stage {
  Piece piece;
  double bound = 0;
  std::vector<double> errors;  ///< Reduced::errors, but to the chain's source; empty if not known
  double planes_left = 0;      ///< Level::planes_left
};

/// The last level of the chain, and the reducer that continues from there.
class ChainMaker {
 public:
  ChainMaker(const Surface& source, std::span<const uint8_t> locked, const LayeredPlanes& planes,
             const SimplifyLimits& limits)
      : source_(source), limits_(limits), locked_(locked.begin(), locked.end()), planes_(planes) {
    current_.piece.surface = source;
    current_.piece.sources.resize(source.points.size());
    std::iota(current_.piece.sources.begin(), current_.piece.sources.end(), 0u);
    if (limits.colors == Colors::ignore) heap_below_ = heap_below(source, locked);
    if (source.triangles.size() / 2 < heap_below_) return;
    start();
    detached_triangles_ = reducer_->detached_triangles();
  }

  /// Of the last level: see Stage.
  const std::vector<double>& errors() const { return current_.errors; }
  size_t triangles() const { return current_.piece.surface.triangles.size(); }
  /// Of the source; 0 where nothing but clustering was asked for.
  size_t detached_triangles() const { return detached_triangles_; }
  /// Whether the last next() returned nothing because of max_bound.
  bool at_limit() const { return at_limit_; }

  /// The next level, of about `goal` triangles; nullopt if that is not possible.
  std::optional<Level> next(size_t goal) {
    const auto enough = static_cast<size_t>(static_cast<double>(triangles()) * worth_it);
    if (goal < heap_below_) {
      Stage clustered = cluster(current_, goal);
      if (clustered.piece.surface.triangles.size() > enough) return std::nullopt;
      current_ = std::move(clustered);
      return measured();
    }
    if (!reducer_) start();
    Stage reduced = reduce(goal);
    const bool got_there = reduced.piece.surface.triangles.size() <= enough;
    at_limit_ = !got_there && reduced_further_;
    if (!got_there || (is_steep(reduced) && clusters_better(goal, reduced.bound))) {
      // From where the reducer got stuck, or, if its result is too far off, from before.
      Stage clustered = cluster(got_there ? current_ : reduced, goal);
      const size_t count = clustered.piece.surface.triangles.size();
      if (count <= enough && (!got_there || clustered.bound < reduced.bound)) {
        current_ = std::move(clustered);
        start();
        return measured();
      }
    }
    if (!got_there) return std::nullopt;
    current_ = std::move(reduced);
    return measured();
  }

 private:
  void start() {
    start_ = current_;
    start_locked_ = locked_of(start_.piece);
    start_planes_ = planes_.of(start_.piece.sources);
    reducer_ = make_reducer(limits_.simplifier, start_.piece.surface, start_locked_, start_planes_);
  }

  /// The reducer's next surface, with its fast bound.
  Stage reduce(size_t goal) {
    // The tight bound may be smaller by this factor.
    const double largest = limits_.max_bound * (is_measured() ? 4 : 1);
    Reduced reduced = reducer_->reduce_to(goal, largest - start_.bound);
    reduced_further_ = reduced.further;
    Stage level{std::move(reduced.piece), 0, std::move(reduced.errors),
                std::max(start_.planes_left, reduced.planes_left)};
    for (double& error : level.errors) error += start_.bound;
    level.bound = reduced.bound ? start_.bound + *reduced.bound
                                : current_.bound + distance_bound(current_.piece.surface, level.piece.surface,
                                                                  limits_.colors, {hurried});
    for (uint32_t& source : level.piece.sources) source = start_.piece.sources[source];
    return level;
  }

  std::vector<uint8_t> locked_of(const Piece& piece) const {
    std::vector<uint8_t> locked;
    if (!locked_.empty()) {
      for (const uint32_t source : piece.sources) locked.push_back(locked_[source]);
    }
    return locked;
  }

  Stage cluster(const Stage& from, size_t goal) const {
    Clustered clustered = cluster_to(from.piece.surface, locked_of(from.piece), goal, limits_.colors,
                                     planes_.of(from.piece.sources));
    Stage level{std::move(clustered.piece),
                from.bound + clustered.bound,
                {},
                std::max(from.planes_left, clustered.planes_left)};
    for (uint32_t& source : level.piece.sources) source = from.piece.sources[source];
    return level;
  }

  bool is_steep(const Stage& next) const { return next.bound > steep * std::max(current_.bound, 1.0); }

  /// Clustering moves points by about a cell: a single clustering shows whether searching for the best is
  /// worth it.
  bool clusters_better(size_t goal, double bound) const {
    const double cell = bound - current_.bound;
    return clusters_within(current_.piece.surface, locked_of(current_.piece), cell, goal, limits_.colors,
                           planes_.of(current_.piece.sources));
  }

  /// Distances that are measured do not tell how colours of corners change.
  bool is_measured() const { return limits_.bound == Bound::tight && source_.colors.empty(); }

  Level measured() {
    Level level{current_.piece, current_.bound, 0, current_.planes_left};
    if (is_measured()) {
      if (!meter_) meter_.emplace(source_, limits_.colors);
      level.bound = meter_->bound(level.piece.surface, {tight, level.bound, current_.errors});
    }
    level.bound = last_bound_ = std::max({level.bound, level.planes_left, last_bound_});
    return level;
  }

  const Surface& source_;
  const SimplifyLimits& limits_;
  std::vector<uint8_t> locked_;  ///< for each point of the source
  const LayeredPlanes& planes_;  ///< of the source
  Stage start_, current_;        ///< where the reducer began, where it is; sources in the source
  std::vector<uint8_t> start_locked_;
  LayeredPlanes start_planes_;
  std::unique_ptr<Reducer> reducer_;
  std::optional<DistanceMeter> meter_;
  size_t heap_below_ = 0;  ///< for goals below this, vertices are clustered at once
  double last_bound_ = 0;  ///< of the levels given
  size_t detached_triangles_ = 0;
  bool reduced_further_ = false, at_limit_ = false;
};

}  // namespace

Chain collapse_chain(const Surface& surface, std::span<const uint8_t> locked, const SimplifyLimits& limits,
                     const FirstLevel& first) {
  Chain chain;
  const auto locked_points = static_cast<size_t>(std::count(locked.begin(), locked.end(), 1));
  const size_t enough = limits.triangles + 2 * locked_points;
  if (surface.triangles.size() <= enough) return chain;
  const LayeredPlanes planes(surface);
  ChainMaker maker(surface, locked, planes, limits);
  std::optional<CoverKeeper> cover;
  std::optional<DistanceMeter> meter;
  if (limits.keep_cover) cover.emplace(surface, locked, planes);
  while (maker.triangles() > enough) {
    const bool as_asked = chain.levels.empty() && first.triangles > 0;
    const size_t goal = as_asked ? first.triangles : maker.triangles() / 2;
    auto level = maker.next(std::max(goal, enough * 2 / 3));
    chain.stuck = !level && !maker.at_limit();
    if (!level || level->bound > limits.max_bound) break;
    if (cover) {
      const std::vector<glm::ivec3> before = level->piece.surface.points;
      const double bound = level->bound;
      level->moved = cover->restore(level->piece, bound, first.cover);
      if (level->moved > 0) level->bound = moved_bound(bound, level->piece.surface, before, maker.errors());
      if (level->bound > bound * (1 + much) && surface.triangles.size() <= quickly_measured &&
          surface.colors.empty() && limits.colors == Colors::keep) {
        if (!meter) meter.emplace(surface, limits.colors);
        level->bound =
            std::max(meter->bound(level->piece.surface, {tight, level->bound, {}}), level->planes_left);
      }
    }
    if (!chain.levels.empty()) level->bound = std::max(level->bound, chain.levels.back().bound);
    chain.levels.push_back(std::move(*level));
  }
  chain.detached_triangles = maker.detached_triangles();
  return chain;
}

}  // namespace triptych
