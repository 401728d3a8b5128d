#include "lod/simplify.hpp"

#include <algorithm>
#include <optional>

#include "lod/decimate.hpp"
#include "lod/distance.hpp"
#include "lod/vertex_clustering.hpp"

namespace triptych {

namespace {

/// A level must have at most this share of the triangles of the one before it, or it is not worth its place.
constexpr double worth_it = 0.75;

/// What the chain has arrived at, and the decimation that goes on from there.
class Simplifier {
 public:
  Simplifier(const Surface& surface, std::span<const uint8_t> locked, Colors colors)
      : colors_(colors), locked_(locked.begin(), locked.end()) {
    current_.surface = surface;
    for (uint32_t i = 0; i < surface.points.size(); ++i) current_.sources.push_back(i);
    start_decimation();
  }

  size_t triangles() const { return current_.surface.triangles.size(); }
  size_t detached_triangles() const { return detached_triangles_; }

  /// Goes on to about `goal` triangles; nothing if neither way gets far enough.
  std::optional<Level> next(size_t goal) {
    const auto enough = static_cast<size_t>(static_cast<double>(triangles()) * worth_it);
    std::optional<Piece> collapsed;
    double collapsed_bound = 0;
    if (decimation_) {
      collapsed = decimation_->reduce_to(goal);
      if (collapsed->surface.triangles.empty() || collapsed->surface.triangles.size() > enough) {
        collapsed.reset();
        decimation_.reset();
      } else {
        for (uint32_t& source : collapsed->sources) source = decimated_from_[source];
        collapsed_bound = distance_bound(current_.surface, collapsed->surface, colors_);
      }
    }
    // Clustering moves points by about a cell: if cells of the collapses' bound leave more triangles, it is no better.
    if (collapsed && cluster_vertices(current_.surface, locked_, collapsed_bound).piece.surface.triangles.size() > goal) {
      take(std::move(*collapsed), collapsed_bound);
      return Level{current_, bound_};
    }
    Clustered clustered = cluster_to(current_.surface, locked_, goal);
    const bool clusters = clustered.piece.surface.triangles.size() <= enough;
    if (!clusters && !collapsed) return std::nullopt;
    double clustered_bound = 0;
    if (clusters) {
      clustered_bound = distance_bound(current_.surface, clustered.piece.surface, colors_);
      // By construction, where colours do not count.
      if (colors_ == Colors::ignore) clustered_bound = std::min(clustered_bound, clustered.bound);
    }
    if (!clusters || (collapsed && collapsed_bound <= clustered_bound)) {
      take(std::move(*collapsed), collapsed_bound);
    } else {
      for (uint32_t& source : clustered.piece.sources) source = current_.sources[source];
      take(std::move(clustered.piece), clustered_bound);
      start_decimation();
    }
    return Level{current_, bound_};
  }

 private:
  void start_decimation() {
    decimation_ = std::make_unique<Decimation>(current_.surface, locked_);
    decimated_from_ = current_.sources;
    detached_triangles_ = std::max(detached_triangles_, decimation_->detached_triangles());
  }

  void take(Piece piece, double bound) {
    if (!locked_.empty()) {
      std::vector<uint8_t> all(current_.sources.empty() ? 0 : *std::max_element(current_.sources.begin(), current_.sources.end()) + size_t{1});
      for (size_t i = 0; i < current_.sources.size(); ++i) all[current_.sources[i]] = locked_[i];
      locked_.clear();
      for (const uint32_t source : piece.sources) locked_.push_back(all[source]);
    }
    current_ = std::move(piece);
    bound_ += bound;
  }

  Colors colors_;
  Piece current_;  ///< sources: in the surface that the chain began with
  std::vector<uint8_t> locked_;
  double bound_ = 0;
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
