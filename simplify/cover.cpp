#include "simplify/cover.hpp"

#include "simplify/spread_corners.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

namespace triptych {

namespace {

/// Components that are thicker than so many bounds lose too little to show.
constexpr double thick = 8;
/// What is no larger than so many bounds may stand for others that vanished, and may be flat.
constexpr double small = 2;
/// A smaller loss than this share is left alone.
constexpr double negligible = 0.02;
/// Nothing is enlarged of a material that lost less than this share altogether.
constexpr double little = 0.05;
/// What others could not regain makes a component at most so many times as large.
constexpr double most_taken_over = 1.5;
/// At most this far, of the bound; and what is small.
constexpr double furthest = 0.5, furthest_of_small = 1;

/// Points or triangles by component.
struct Members {
  template <typename ComponentOf>
  Members(size_t components, size_t count, const ComponentOf& component_of) : first(components + 1, 0) {
    for (uint32_t i = 0; i < count; ++i) ++first[component_of(i) + 1];
    for (size_t i = 0; i < components; ++i) first[i + 1] += first[i];
    members.resize(count);
    std::vector<uint32_t> next = first;
    for (uint32_t i = 0; i < count; ++i) members[next[component_of(i)]++] = i;
  }
  std::span<const uint32_t> of(size_t component) const {
    return std::span(members).subspan(first[component], first[component + 1] - first[component]);
  }
  std::vector<uint32_t> first, members;
};

/// What components could not regain, as some points of theirs are locked or all would have to go too far,
/// goes to others of the same material that could.
std::vector<double> handed_over(const std::vector<double>& wanted, const std::vector<double>& regained,
                                const std::vector<Cover>& covers) {
  struct Sums {
    double missing = 0, able = 0;
  };
  const auto is_able = [&](size_t i) { return regained[i] > wanted[i] * (1 - negligible); };
  std::map<uint32_t, Sums> sums;  // by material
  for (size_t i = 0; i < wanted.size(); ++i) {
    if (!(regained[i] > 0)) continue;
    Sums& own = sums[covers[i].material];
    if (is_able(i)) {
      own.able += wanted[i];
    } else {
      own.missing += wanted[i] - regained[i];
    }
  }
  std::vector<double> more(wanted.size(), 0);
  for (size_t i = 0; i < wanted.size(); ++i) {
    const Sums& own = sums[covers[i].material];
    if (regained[i] > 0 && is_able(i) && own.missing > 0)
      more[i] = wanted[i] * std::min(1 + own.missing / own.able, most_taken_over);
  }
  return more;
}

}  // namespace

/// Where the points are after they moved so far.
class CoverKeeper::Growth {
 public:
  explicit Growth(const Surface& surface) : surface_(surface), ways(surface.points.size(), glm::dvec3(0)) {}

  glm::dvec3 place(uint32_t point, double distance) const {
    return glm::dvec3(surface_.points[point]) + ways[point] * distance;
  }
  glm::ivec3 rounded(uint32_t point, double distance) const {
    return distance == 0 ? surface_.points[point] : glm::ivec3(glm::round(place(point, distance)));
  }
  double covered(std::span<const uint32_t> triangles, double distance) const {
    double area = 0;
    glm::dvec3 normals(0);
    for (const uint32_t triangle : triangles) {
      const auto& [a, b, c] = surface_.triangles[triangle].vertices;
      const glm::dvec3 normal = area_normal(place(a, distance), place(b, distance), place(c, distance));
      area += glm::length(normal);
      normals += normal;
    }
    return mean_cover(area, normals);
  }
  /// The least distance up to `most` at which so much is covered, roughly; `most` if none is.
  double distance_for(std::span<const uint32_t> triangles, double goal, double most) const {
    double low = 0, high = most;
    double at_low = covered(triangles, 0), at_high = covered(triangles, most);
    if (!(at_high > at_low)) return 0;
    if (at_high <= goal) return most;
    double best = high;
    for (int i = 0; i < 6 && at_high > goal * (1 + negligible / 2); ++i) {
      const double share = std::clamp((goal - at_low) / (at_high - at_low), 0.05, 0.95);
      best = low + (high - low) * share;
      const double there = covered(triangles, best);
      if (there >= goal) {
        high = best;
        at_high = there;
      } else {
        if (there >= goal * (1 - negligible / 2)) return best;
        low = best;
        at_low = there;
      }
    }
    return high;
  }

  /// Sets the ways of three or four points, spread around a middle so that they cover so much, and returns
  /// how far they then go.
  double spread(std::span<const uint32_t> points, std::span<const uint32_t> triangles,
                const glm::dvec3& middle, double goal) {
    std::vector<glm::dvec3> places;
    for (const uint32_t i : points) places.push_back(glm::dvec3(surface_.points[i]));
    const std::vector<glm::dvec3> directions = spread_corners(places);
    const auto direction = [&](uint32_t point) {
      return directions[static_cast<size_t>(std::find(points.begin(), points.end(), point) - points.begin())];
    };
    double area = 0;
    glm::dvec3 normals(0);
    for (const uint32_t triangle : triangles) {
      const auto& [a, b, c] = surface_.triangles[triangle].vertices;
      const glm::dvec3 normal = area_normal(direction(a), direction(b), direction(c));
      area += glm::length(normal);
      normals += normal;
    }
    const double reach = std::sqrt(goal / mean_cover(area, normals));
    for (size_t k = 0; k < points.size(); ++k) ways[points[k]] = middle + directions[k] * reach - places[k];
    return normalize(points);
  }
  /// Sets the ways of points that are scaled from one middle to another, and returns how far they go.
  double scale(std::span<const uint32_t> points, const glm::dvec3& from, const glm::dvec3& to,
               double factor) {
    for (const uint32_t i : points)
      ways[i] = to + (place(i, 0) - from) * factor - glm::dvec3(surface_.points[i]);
    return normalize(points);
  }

 private:
  /// Divides the points' ways by the length of the longest, which is returned.
  double normalize(std::span<const uint32_t> points) {
    double longest = 1e-9;
    for (const uint32_t i : points) longest = std::max(longest, glm::length(ways[i]));
    for (const uint32_t i : points) ways[i] /= longest;
    return longest;
  }

  const Surface& surface_;

 public:
  std::vector<glm::dvec3> ways;  ///< for each point where it goes, none longer than 1
};

/// What each component of the level should cover.
std::vector<double> CoverKeeper::goals(const Piece& level, const ComponentCovers& of_level,
                                       double bound) const {
  const std::vector<Cover>& covers = of_level.covers;
  // Each component of the source belongs to the first of the level that holds a point of it.
  std::vector<double> wanted(covers.size(), 0);
  std::vector<uint8_t> there(source_.covers.size(), 0), holds_locked(covers.size(), 0);
  for (uint32_t i = 0; i < level.sources.size(); ++i) {
    const uint32_t component = of_level.component_of[i], own = source_.component_of[level.sources[i]];
    if (is_locked(level, i)) holds_locked[component] = 1;
    if (there[own]) continue;
    there[own] = 1;
    wanted[component] += source_.covers[own].covered;
  }
  std::map<uint32_t, double> vanished, taking_over;  // by material
  for (size_t i = 0; i < there.size(); ++i) {
    if (!there[i]) vanished[source_.covers[i].material] += source_.covers[i].covered;
  }
  struct Kept {
    double whole = 0, kept = 0;
  };
  std::map<uint32_t, Kept> kept;  // by material
  for (const Cover& cover : source_.covers) kept[cover.material].whole += cover.covered;
  for (size_t i = 0; i < covers.size(); ++i)
    kept[covers[i].material].kept += std::min(wanted[i], covers[i].covered);
  const auto takes_over = [&](size_t i) { return !holds_locked[i] && covers[i].radius <= small * bound; };
  for (size_t i = 0; i < covers.size(); ++i) {
    if (takes_over(i)) taking_over[covers[i].material] += wanted[i];
  }
  for (size_t i = 0; i < covers.size(); ++i) {
    const Cover& cover = covers[i];
    if (takes_over(i)) {
      const auto gone = vanished.find(cover.material);
      if (gone != vanished.end() && taking_over[cover.material] > 0)
        wanted[i] *= 1 + gone->second / taking_over[cover.material];
    } else if (cover.flatness > 0.5 && !cover.is_long()) {
      wanted[i] = 0;  // a sheet does not grow beyond its outline
    }
    const Kept& own = kept[cover.material];
    if (cover.thickness > thick * bound || own.kept >= own.whole * (1 - little)) wanted[i] = 0;
  }
  return wanted;
}

/// Sets the ways of a component's points, and returns how far they may go.
double CoverKeeper::set_ways(Growth& growth, const Piece& level, const Cover& cover,
                             std::span<const uint32_t> points, std::span<const uint32_t> triangles,
                             double goal, double bound) {
  bool movable = true, compact = true;
  for (const uint32_t i : points) {
    movable = movable && !is_locked(level, i);
    compact = compact && !of_source(level, i).is_long();
  }
  const bool is_small = cover.radius <= small * bound;
  if (movable && compact && is_small && (points.size() == 3 || points.size() == 4)) {
    const double most = growth.spread(points, triangles, middle_of(level, points), goal);
    return std::min(most, furthest_of_small * bound);
  }
  if (movable && compact && is_small) {
    const double most =
        growth.scale(points, cover.middle, middle_of(level, points), std::sqrt(goal / cover.covered));
    return std::min(most, furthest_of_small * bound);
  }
  for (const uint32_t i : points) {
    if (is_locked(level, i)) continue;
    const glm::dvec3 point(level.surface.points[i]);
    const Cover& own = of_source(level, i);
    if (own.is_long()) {
      const glm::dvec3 way = point - middles_.around(level.sources[i]);
      growth.ways[i] = way / std::max({glm::length(way), own.thickness / 2, 1e-9});
    } else {
      growth.ways[i] = (point - cover.middle) / std::max(cover.radius, 1.0);
    }
  }
  return (is_small ? furthest_of_small : furthest) * bound;
}

/// What stands on a plane, or hangs from it, stays there: points that lie in a plane in which the component
/// has some stay in it, and others on their side. False where they do so anyway.
bool CoverKeeper::keep_sides(Growth& growth, const Piece& level, std::span<const uint32_t> points,
                             double most) const {
  std::vector<uint32_t> planes;
  for (const uint32_t i : points) {
    for (const uint32_t plane : planes_.planes_of(level.sources[i])) {
      if (std::find(planes.begin(), planes.end(), plane) == planes.end()) planes.push_back(plane);
    }
  }
  bool any = false;
  for (const uint32_t i : points) {
    glm::dvec3& way = growth.ways[i];
    const glm::dvec3 wanted = way;
    way = planes_.within(level.sources[i], way);
    for (const uint32_t plane : planes) {
      const double before = planes_.height(plane, growth.place(i, 0)),
                   after = planes_.height(plane, growth.place(i, most));
      if (!planes_.is_in(level.sources[i], plane) && before * after < 0) way = planes_.along(plane, way);
    }
    any = any || way != wanted;
  }
  return any;
}

/// Sets the ways of a component's points, and returns how far they should go.
double CoverKeeper::enlarge(Growth& growth, const Piece& level, const Cover& cover,
                            std::span<const uint32_t> points, std::span<const uint32_t> triangles,
                            double goal, double bound) {
  double most = set_ways(growth, level, cover, points, triangles, goal, bound);
  // What cannot go its whole way goes further along what is left of it.
  if (!planes_.empty() && keep_sides(growth, level, points, most) && cover.radius <= small * bound)
    most = std::max(most, furthest_of_small * bound);
  return growth.distance_for(triangles, goal, most);
}

/// The middle of what the points are of, in the source.
glm::dvec3 CoverKeeper::middle_of(const Piece& level, std::span<const uint32_t> points) const {
  glm::dvec3 middle(0);
  double covered = 0;
  for (const uint32_t i : points) {
    const Cover& own = of_source(level, i);
    middle += own.middle * own.covered;
    covered += own.covered;
  }
  return middle / covered;
}

double CoverKeeper::restore(Piece& level, double bound, double share) {
  Surface& surface = level.surface;
  const ComponentCovers of_level(surface);
  std::vector<double> wanted = goals(level, of_level, bound);
  for (double& goal : wanted) goal *= share;
  const auto& component_of = of_level.component_of;
  const size_t count = of_level.covers.size();
  const auto grows = [&](size_t i) {
    const double covered = of_level.covers[i].covered;
    return covered > 0 && wanted[i] > covered * (1 + negligible);
  };
  bool any = false;
  for (size_t i = 0; i < count; ++i) any = any || grows(i);
  if (!any) return 0;

  Growth growth(surface);
  const Members triangles(count, surface.triangles.size(),
                          [&](uint32_t i) { return component_of[surface.triangles[i].vertices[0]]; });
  const Members points(count, surface.points.size(), [&](uint32_t i) { return component_of[i]; });
  std::vector<double> distances(count, 0), regained(count, 0);
  const auto enlarge_to = [&](size_t i, double goal) {
    distances[i] = enlarge(growth, level, of_level.covers[i], points.of(i), triangles.of(i), goal, bound);
    regained[i] = growth.covered(triangles.of(i), distances[i]);
  };
  for (size_t i = 0; i < count; ++i) {
    if (grows(i)) enlarge_to(i, wanted[i]);
  }
  const std::vector<double> more = handed_over(wanted, regained, of_level.covers);
  for (size_t i = 0; i < count; ++i) {
    if (more[i] > 0) enlarge_to(i, more[i]);
  }
  const auto grown = [&](uint32_t i) { return growth.rounded(i, distances[component_of[i]]); };
  for (const Triangle& triangle : surface.triangles) {  // rounding must leave each an area
    const auto& [a, b, c] = triangle.vertices;
    if (degenerate(grown(a), grown(b), grown(c))) distances[component_of[a]] = 0;
  }
  double moved = 0;
  std::vector<glm::ivec3> places;
  for (uint32_t i = 0; i < surface.points.size(); ++i) {
    places.push_back(grown(i));
    moved = std::max(moved, glm::distance(glm::dvec3(places[i]), glm::dvec3(surface.points[i])));
  }
  surface.points = std::move(places);
  return moved;
}

}  // namespace triptych
