#include "lod/simplify.hpp"

#include "lod/decimate.hpp"
#include "lod/vertex_clustering.hpp"

#include <algorithm>
#include <memory>
#include <optional>

namespace triptych {

namespace {

/// A level must have at most this share of the triangles of the one before it, or it is not worth its place.
constexpr double worth_it = 0.75;

/// What the chain has arrived at, and the decimation that goes on from there.
class Simplifier {
 public:
  Simplifier(const Surface& source, std::span<const uint8_t> locked, Colors colors)
      : source_(source), locked_(locked), colors_(colors) {
    current_.surface = source;
    for (uint32_t i = 0; i < source.points.size(); ++i) current_.sources.push_back(i);
    start_decimation();
    detached_triangles_ = decimation_->detached_triangles();
  }

  size_t triangles() const { return current_.surface.triangles.size(); }
  size_t detached_triangles() const { return detached_triangles_; }

  /// Goes on to about `goal` triangles; nothing if neither way gets far enough.
  std::optional<Level> next(size_t goal) {
    const auto enough = static_cast<size_t>(static_cast<double>(triangles()) * worth_it);
    auto collapsed = collapse(goal, enough);
    // Clustering moves points by about a cell: where cells as large as the collapses' bound leave too many
    // triangles, it is no better.
    auto clustered =
        collapsed && !clusters_well(goal, collapsed->bound) ? std::nullopt : cluster(goal, enough);
    if (clustered && (!collapsed || clustered->bound < collapsed->bound)) {
      current_ = clustered->piece;
      bound_ = clustered->bound;
      start_decimation();
      return clustered;
    }
    if (collapsed) {
      current_ = collapsed->piece;
      bound_ = collapsed->bound;
    }
    return collapsed;
  }

 private:
  void start_decimation() {
    decimation_ = std::make_unique<Decimation>(current_.surface, locked_now());
    decimated_from_ = current_.sources;
  }

  std::optional<Level> collapse(size_t goal, size_t enough) {
    if (!decimation_) return std::nullopt;
    Piece piece = decimation_->reduce_to(goal);
    if (piece.surface.triangles.empty() || piece.surface.triangles.size() > enough) {
      decimation_.reset();
      return std::nullopt;
    }
    for (uint32_t& source : piece.sources) source = decimated_from_[source];
    const double bound = distance_bound(source_, piece.surface, colors_);
    return Level{std::move(piece), std::max(bound, bound_)};
  }

  bool clusters_well(size_t goal, double cell) const {
    if (!(cell > 1)) return false;
    return cluster_vertices(current_.surface, locked_now(), cell).piece.surface.triangles.size() <= goal;
  }

  std::optional<Level> cluster(size_t goal, size_t enough) const {
    Clustered clustered = cluster_to(current_.surface, locked_now(), goal);
    if (clustered.piece.surface.triangles.size() > enough) return std::nullopt;
    for (uint32_t& source : clustered.piece.sources) source = current_.sources[source];
    double bound = distance_bound(source_, clustered.piece.surface, colors_);
    // By construction, where colours do not count.
    if (colors_ == Colors::ignore) bound = std::min(bound, bound_ + clustered.bound);
    return Level{std::move(clustered.piece), std::max(bound, bound_)};
  }

  std::vector<uint8_t> locked_now() const {
    std::vector<uint8_t> locked;
    if (!locked_.empty()) {
      for (const uint32_t source : current_.sources) locked.push_back(locked_[source]);
    }
    return locked;
  }

  const Surface& source_;
  std::span<const uint8_t> locked_;  ///< for each point of the source
  Colors colors_;
  Piece current_;     ///< sources: in the source
  double bound_ = 0;  ///< of its distance to the source
  std::unique_ptr<Decimation> decimation_;
  std::vector<uint32_t> decimated_from_;  ///< sources of the surface that decimation_ began with
  size_t detached_triangles_ = 0;
};

}  // namespace

Chain simplify(const Surface& surface, std::span<const uint8_t> locked, const SimplifyLimits& limits) {
  Chain chain;
  if (surface.triangles.size() <= limits.triangles) return chain;
  Simplifier simplifier(surface, locked, limits.colors);
  while (simplifier.triangles() > limits.triangles) {
    auto level = simplifier.next(std::max(simplifier.triangles() / 2, limits.triangles * 2 / 3));
    chain.stuck = !level;
    if (!level || level->bound > limits.largest_bound) break;
    chain.levels.push_back(std::move(*level));
  }
  chain.detached_triangles = simplifier.detached_triangles();
  return chain;
}

}  // namespace triptych
