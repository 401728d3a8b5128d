#include "simplify/simplify.hpp"

#include "simplify/care.hpp"
#include "simplify/collapse_chain.hpp"
#include "simplify/component_covers.hpp"
#include "simplify/stand_ins.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace triptych {

namespace {

/// A level must have at most this share of the triangles of the one before it.
constexpr double worth_it = 0.75;
/// Stand-ins are looked for where at least this share of the triangles is in components that have them.
constexpr double enough_convex = 0.25;

size_t least_convex(const Surface& surface) {
  return std::max<size_t>(
      1, static_cast<size_t>(std::ceil(enough_convex * static_cast<double>(surface.triangles.size()))));
}

/// What of a surface has stand-ins, and what is left of it.
class Parts {
 public:
  Parts(const Surface& surface, std::span<const uint8_t> locked, const SimplifyLimits& limits)
      : surface_(surface),
        covers_(surface),
        components_(convex_components(surface, locked, limits.max_bound, least_convex(surface))) {
    std::vector<uint8_t> is_convex(surface.triangles.size(), 0);
    for (const ConvexComponent& component : components_) {
      for (const uint32_t triangle : component.triangles) is_convex[triangle] = 1;
      convex_ += component.triangles.size();
    }
    if (!pays() || convex_ == surface.triangles.size()) return;
    std::vector<Triangle> rest;
    for (size_t i = 0; i < is_convex.size(); ++i) {
      if (!is_convex[i]) rest.push_back(surface.triangles[i]);
    }
    rest_ = extract(surface.points, rest);
    std::vector<uint8_t> locked_rest;
    if (!locked.empty()) {
      for (const uint32_t source : rest_.sources) locked_rest.push_back(locked[source]);
    }
    chain_ = collapse_chain(rest_.surface, locked_rest, limits);
    take_care_of_wires(rest_.surface, chain_.levels);
    for (Level& level : chain_.levels) {
      for (uint32_t& source : level.piece.sources) source = rest_.sources[source];
    }
  }

  bool pays() const { return convex_ >= least_convex(surface_); }
  size_t detached_triangles() const { return chain_.detached_triangles; }

  /// All bounds at which something gets coarser, ascending.
  std::vector<double> bounds() const {
    std::vector<double> bounds;
    for (const Level& level : chain_.levels) bounds.push_back(level.bound);
    for (const ConvexComponent& component : components_) {
      for (const StandIn& stand_in : component.stand_ins) bounds.push_back(bound_of(component, stand_in));
    }
    std::sort(bounds.begin(), bounds.end());
    return bounds;
  }

  size_t triangles_at(double bound) const {
    const Level* const rest = rest_at(bound);
    size_t count = rest ? rest->piece.surface.triangles.size() : rest_.surface.triangles.size();
    for (const ConvexComponent& component : components_) {
      const StandIn* const stand_in = at(component, bound);
      count += stand_in ? stand_in->piece.surface.triangles.size() : component.triangles.size();
    }
    return count;
  }

  /// Everything at its coarsest within a bound.
  Level level_at(double bound) const {
    Level level;
    if (const Level* const rest = rest_at(bound)) {
      level = *rest;
    } else {
      level.piece = rest_;
    }
    for (const ConvexComponent& component : components_) {
      if (const StandIn* const stand_in = at(component, bound)) {
        append(stand_in->piece, level.piece);
        level.bound = std::max(level.bound, bound_of(component, *stand_in));
        level.moved = std::max(level.moved, stand_in->bound);
      } else {
        std::vector<Triangle> own;
        for (const uint32_t triangle : component.triangles) own.push_back(surface_.triangles[triangle]);
        append(extract(surface_.points, own), level.piece);
      }
    }
    return level;
  }

 private:
  const Level* rest_at(double bound) const {
    const Level* found = nullptr;
    for (const Level& level : chain_.levels) {
      if (level.bound <= bound) found = &level;
    }
    return found;
  }
  double bound_of(const ConvexComponent& component, const StandIn& stand_in) const {
    const uint32_t point = surface_.triangles[component.triangles.front()].vertices[0];
    const Cover& cover = covers_.covers[covers_.component_of[point]];
    return cover.is_wire() ? bound_of_wire(stand_in.bound, cover.thickness) : stand_in.bound;
  }
  const StandIn* at(const ConvexComponent& component, double bound) const {
    const StandIn* found = nullptr;
    for (const StandIn& stand_in : component.stand_ins) {
      if (bound_of(component, stand_in) <= bound) found = &stand_in;
    }
    return found;
  }
  static void append(const Piece& piece, Piece& to) {
    const auto first = static_cast<uint32_t>(to.sources.size());
    to.sources.insert(to.sources.end(), piece.sources.begin(), piece.sources.end());
    to.surface.points.insert(to.surface.points.end(), piece.surface.points.begin(),
                             piece.surface.points.end());
    for (Triangle triangle : piece.surface.triangles) {
      for (uint32_t& vertex : triangle.vertices) vertex += first;
      to.surface.triangles.push_back(triangle);
    }
  }

  const Surface& surface_;
  ComponentCovers covers_;
  std::vector<ConvexComponent> components_;
  size_t convex_ = 0;  ///< triangles in them
  Piece rest_;
  Chain chain_;  ///< of the rest; sources in the surface
};

/// The chain goes on from its last level, or the surface, all of it at once.
void go_on(const Surface& surface, std::span<const uint8_t> locked, const SimplifyLimits& limits,
           Chain& chain) {
  Level from;
  if (chain.levels.empty()) {
    from.piece = {surface, std::vector<uint32_t>(surface.points.size())};
    std::iota(from.piece.sources.begin(), from.piece.sources.end(), 0u);
  } else {
    from = chain.levels.back();
  }
  std::vector<uint8_t> own_locked;
  if (!locked.empty()) {
    for (const uint32_t source : from.piece.sources) own_locked.push_back(locked[source]);
  }
  SimplifyLimits left = limits;
  left.max_bound -= from.bound;
  Chain more =
      collapse_chain(from.piece.surface, own_locked, left, first_level_of_scattered(from.piece.surface));
  take_care_of_wires(from.piece.surface, more.levels);
  for (Level& level : more.levels) {
    for (uint32_t& source : level.piece.sources) source = from.piece.sources[source];
    level.bound += from.bound;
    level.moved += from.moved;
    level.planes_left = std::max(level.planes_left, from.planes_left);
  }
  std::ranges::move(more.levels, std::back_inserter(chain.levels));
  chain.stuck = more.stuck;
  chain.detached_triangles += more.detached_triangles;
}

Chain chain_by_parts(const Surface& surface, std::span<const uint8_t> locked, const SimplifyLimits& limits) {
  Chain chain;
  const Parts parts(surface, locked, limits);
  if (parts.pays()) {
    const auto locked_points = static_cast<size_t>(std::ranges::count(locked, 1));
    const size_t enough = limits.triangles + 2 * locked_points;
    const std::vector<double> bounds = parts.bounds();
    size_t triangles = surface.triangles.size();
    for (auto bound = bounds.begin(); bound != bounds.end() && triangles > enough;
         bound = std::upper_bound(bounds.begin(), bounds.end(), *bound)) {
      const size_t there = parts.triangles_at(*bound);
      const bool last = *bound == bounds.back() && there < triangles;
      if (!last && static_cast<double>(there) > worth_it * static_cast<double>(triangles)) continue;
      if (!chain.levels.empty() && *bound < 1.5 * chain.levels.back().bound) chain.levels.pop_back();
      chain.levels.push_back(parts.level_at(*bound));
      triangles = there;
    }
    chain.detached_triangles = parts.detached_triangles();
  }
  go_on(surface, locked, limits, chain);
  return chain;
}

}  // namespace

Chain simplify(const Surface& surface, std::span<const uint8_t> locked, const SimplifyLimits& limits) {
  if (!limits.keep_cover) return collapse_chain(surface, locked, limits);
  Chain chain = chain_by_parts(surface, locked, limits);
  take_care_of_scattered(surface, chain.levels);
  return chain;
}

}  // namespace triptych
