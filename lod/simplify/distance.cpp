#include "lod/simplify/distance.hpp"

#include "lod/simplify/convex_polygon.hpp"
#include "lod/simplify/triangle_tree.hpp"
#include "scene/key_hash.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <tsl/robin_map.h>
#include <tsl/robin_set.h>
#include <unordered_map>

namespace triptych {

namespace {

/// What is smaller than this, in lattice steps, is not worth a cut: the bound may be so much larger than the
/// truth.
constexpr double floor_distance = 0.25;
/// Cut corners are rounded; this is far above what rounding can do and far below what anybody sees.
constexpr double rounding_allowance = 1e-5;
/// Where the bound is not yet tight after so many cuts on average, it stays as it is: larger, never wrong.
constexpr size_t cuts_a_triangle = 6;

using TriangleSet = tsl::robin_set<std::array<uint32_t, 3>, KeyHash, KeyEqual>;

/// The largest distance of polygons from the triangles of a tree, by branch and bound: the polygon with the
/// largest bound is cut until that bound is nearly reached by some point, or the work is no longer worth it.
class OneSided {
 public:
  /// `lower` is a distance that is known to be reached elsewhere: below it nothing needs to be known exactly.
  OneSided(const TriangleTree& tree, double lower, const DistanceEffort& effort)
      : tree_(tree), effort_(effort), lower_(lower) {}

  /// Whether what is known beforehand is tight enough: then nothing more needs to be known.
  bool settled() const { return effort_.known <= enough(); }

  /// Raises what is known to be reached if the point is further off.
  void reach(const glm::dvec3& point) {
    const auto nearest = tree_.nearest(point, hint_, lower_ * lower_);
    hint_ = nearest.triangle;
    lower_ = std::max(lower_, std::sqrt(nearest.squared_distance));
  }

  /// The exact distance of a point; raises what is known to be reached.
  double touch(const glm::dvec3& point) {
    const auto nearest = tree_.nearest(point, hint_);
    hint_ = nearest.triangle;
    lower_ = std::max(lower_, std::sqrt(nearest.squared_distance));
    return std::sqrt(nearest.squared_distance);
  }

  void add(const Corners& triangle) {
    ConvexPolygon polygon;
    for (const glm::dvec3& corner : triangle) polygon.push_back(corner);
    add(polygon);
  }

  /// The bound of all that was added.
  double finish(size_t most_cuts) {
    for (size_t i = 0; i < most_cuts && !waiting_.empty() && waiting_.front().bound > enough() && !settled();
         ++i) {
      std::pop_heap(waiting_.begin(), waiting_.end());
      const Waiting waiting = waiting_.back();
      waiting_.pop_back();
      hint_ = waiting.near;
      divide(waiting.polygon);
    }
    if (!waiting_.empty()) bound_ = std::max(bound_, waiting_.front().bound);
    return bound_;
  }

  double lower() const { return lower_; }

 private:
  struct Waiting {
    double bound;
    uint32_t near;  ///< the triangle near its middle
    ConvexPolygon polygon;
    bool operator<(const Waiting& other) const { return bound < other.bound; }
  };

  /// A bound up to here needs no cut: it is within the tightness of a distance that is reached somewhere.
  double enough() const { return std::max(floor_distance, lower_ * effort_.tightness); }

  void add(const ConvexPolygon& polygon) {
    if (polygon.size() < 3) return;
    // From the cheapest to the dearest: one triangle may be near all corners, first of all the one that was
    // near the last polygon, then the one near the middle; no point is further off than its way to the middle
    // and on from there.
    double bound = std::sqrt(tree_.squared_distance(polygon, hint_));
    if (bound > enough()) {
      const glm::dvec3 middle = middle_of(polygon);
      double radius = 0;
      for (const glm::dvec3& corner : polygon) radius = std::max(radius, glm::distance(corner, middle));
      bound = std::min(bound, touch(middle) + radius);
    }
    if (bound > enough()) bound = std::min(bound, std::sqrt(tree_.squared_distance(polygon, hint_)));
    if (bound > enough()) {
      const auto found = tree_.within(polygon, enough() * enough());
      if (found.triangle != TriangleTree::no_triangle) bound = std::sqrt(found.squared_distance);
    }
    if (bound <= enough()) {
      bound_ = std::max(bound_, bound);
    } else {
      waiting_.push_back({bound, hint_, polygon});
      std::push_heap(waiting_.begin(), waiting_.end());
    }
  }

  /// Cuts out what lies over the triangle nearest to the polygon's middle; halves the polygon where that
  /// leads nowhere.
  void divide(const ConvexPolygon& polygon) {
    const Corners& near = tree_.triangle(hint_);
    const glm::dvec3 normal = glm::cross(near[1] - near[0], near[2] - near[0]);
    const double slack = enough() * 0.3;
    std::array<ConvexPolygon, 3> beyond;
    ConvexPolygon rest = polygon;
    bool was_cut = false;
    for (size_t i = 0; i < 3 && !rest.empty() && rest.size() < ConvexPolygon::most_corners; ++i) {
      const glm::dvec3 outwards = glm::cross(near[(i + 1) % 3] - near[i], normal);
      const double length = glm::length(outwards);
      if (!(length > 0)) continue;
      const glm::dvec3 direction = outwards / length;
      beyond[i] = cut(rest, direction, glm::dot(direction, near[i]) + slack, slack * 0.2);
      was_cut |= !beyond[i].empty();
    }
    if (rest.empty() || !was_cut) {
      halve(polygon);
    } else {
      add(rest);
      for (const ConvexPolygon& piece : beyond) add(piece);
    }
  }

  void halve(ConvexPolygon polygon) {
    size_t from = 0;
    double longest = -1;
    glm::dvec3 direction{0};
    for (size_t i = 0; i < polygon.size(); ++i) {
      touch(polygon[i]);
      const glm::dvec3 side = polygon[(i + 1) % polygon.size()] - polygon[i];
      if (glm::dot(side, side) > longest) {
        longest = glm::dot(side, side);
        direction = side;
        from = i;
      }
    }
    const ConvexPolygon other =
        cut(polygon, direction, glm::dot(direction, polygon[from] + direction * 0.5), 0);
    add(polygon);
    add(other);
  }

  const TriangleTree& tree_;
  const DistanceEffort effort_;
  double lower_, bound_ = 0;
  uint32_t hint_ = 0;
  std::vector<Waiting> waiting_;
};

Corners corners_of(const Surface& surface, const Triangle& triangle) {
  return {glm::dvec3(surface.points[triangle.vertices[0]]), glm::dvec3(surface.points[triangle.vertices[1]]),
          glm::dvec3(surface.points[triangle.vertices[2]])};
}

using Numbers = tsl::robin_map<glm::ivec3, uint32_t, KeyHash>;

std::array<uint32_t, 3> numbered(const Triangle& triangle, const std::vector<uint32_t>& numbers) {
  std::array<uint32_t, 3> key = {numbers[triangle.vertices[0]], numbers[triangle.vertices[1]],
                                 numbers[triangle.vertices[2]]};
  std::sort(key.begin(), key.end());
  return key;
}

/// Triangles to which distances are measured.
class Target {
 public:
  Target(const Surface& surface, std::span<const Triangle> triangles, const std::vector<uint32_t>& numbers)
      : tree_(all_corners(surface, triangles)) {
    triangles_.reserve(triangles.size());
    for (const Triangle& triangle : triangles) {
      const auto key = numbered(triangle, numbers);
      triangles_.insert(key);
      points_.insert(key.begin(), key.end());
    }
  }

  /// The one-sided distance of the triangles; raises `lower` to what is reached.
  double distance_from(const Surface& surface, std::span<const Triangle> triangles,
                       const std::vector<uint32_t>& numbers, const DistanceEffort& effort,
                       double& lower) const {
    OneSided side(tree_, lower, effort);
    if (side.settled()) return effort.known;
    std::vector<Triangle> changed;
    for (const Triangle& triangle : triangles) {
      if (!triangles_.contains(numbered(triangle, numbers))) changed.push_back(triangle);
    }
    // Corners first: the sooner a large distance is known, the fewer cuts. A few from everywhere to begin
    // with.
    for (const size_t stride : {changed.size() / 61 + 1, size_t{1}}) {
      for (size_t i = 0; i < changed.size() && !side.settled(); i += stride) {
        for (const uint32_t vertex : changed[i].vertices) {
          if (!points_.contains(numbers[vertex])) side.reach(glm::dvec3(surface.points[vertex]));
        }
      }
    }
    double bound = effort.known;
    if (!side.settled()) {
      for (const Triangle& triangle : changed) side.add(corners_of(surface, triangle));
      bound = std::min(bound, side.finish(cuts_a_triangle * changed.size() + 2000));
    }
    lower = side.lower();
    return bound;
  }

 private:
  static std::vector<Corners> all_corners(const Surface& surface, std::span<const Triangle> triangles) {
    std::vector<Corners> corners;
    corners.reserve(triangles.size());
    for (const Triangle& triangle : triangles) corners.push_back(corners_of(surface, triangle));
    return corners;
  }

  TriangleTree tree_;
  TriangleSet triangles_;
  tsl::robin_set<uint32_t, KeyHash> points_;
};

double diagonal(const Surface& surface, std::span<const Triangle> triangles) {
  LatticeBox box;
  for (const Triangle& triangle : triangles) {
    for (const uint32_t vertex : triangle.vertices) box.extend(surface.points[vertex]);
  }
  return glm::length(glm::dvec3(box.hi) - glm::dvec3(box.lo));
}

/// Triangles of one colour that hang together by their points, one patch after another.
std::vector<std::vector<Triangle>> patches(const Surface& surface) {
  std::map<uint32_t, std::vector<Triangle>> by_color;
  for (const Triangle& triangle : surface.triangles) by_color[triangle.material].push_back(triangle);
  std::vector<std::vector<Triangle>> result;
  for (const auto& [color, triangles] : by_color) {
    std::vector<uint32_t> parents(surface.points.size());
    std::iota(parents.begin(), parents.end(), 0u);
    const auto root = [&](uint32_t point) {
      while (parents[point] != point) point = parents[point] = parents[parents[point]];
      return point;
    };
    for (const Triangle& triangle : triangles) {
      for (size_t i = 1; i < 3; ++i) parents[root(triangle.vertices[i])] = root(triangle.vertices[0]);
    }
    std::unordered_map<uint32_t, size_t> places;
    for (const Triangle& triangle : triangles) {
      const auto [found, inserted] = places.try_emplace(root(triangle.vertices[0]), result.size());
      if (inserted) result.emplace_back();
      result[found->second].push_back(triangle);
    }
  }
  return result;
}

/// One of the surfaces that are compared; what it takes to measure from it and to it is made when it is
/// needed.
class Side {
 public:
  /// `numbers`: for each point one that equal points of both surfaces share.
  Side(const Surface& surface, std::vector<uint32_t> numbers, Colors colors)
      : surface_(surface), numbers_(std::move(numbers)), colors_(colors) {}

  /// Each patch against its own colour, or against everything and the patch's own size.
  double distance_to(Side& to, const DistanceEffort& effort, double& lower) {
    if (colors_ == Colors::ignore) {
      return to.everything().distance_from(surface_, surface_.triangles, numbers_, effort, lower);
    }
    if (!patches_) patches_ = patches(surface_);
    double bound = 0;
    for (const auto& patch : *patches_) {
      const double size = diagonal(surface_, patch);
      double own = std::numeric_limits<double>::infinity(), own_lower = lower;
      if (const Target* target = to.of_color(patch[0].material)) {
        own = target->distance_from(surface_, patch, numbers_, effort, own_lower);
      }
      if (own <= std::max(size, lower)) {
        lower = std::max(lower, own_lower);
      } else {
        own = std::min(
            own, std::max(size, to.everything().distance_from(surface_, patch, numbers_, effort, lower)));
        lower = std::max(lower, std::min(size, own));
      }
      bound = std::max(bound, own);
    }
    return bound;
  }

 private:
  Target& everything() {
    if (!everything_) everything_.emplace(surface_, surface_.triangles, numbers_);
    return *everything_;
  }

  const Target* of_color(uint32_t color) {
    if (by_color_.empty()) {
      std::map<uint32_t, std::vector<Triangle>> triangles;
      for (const Triangle& triangle : surface_.triangles) triangles[triangle.material].push_back(triangle);
      for (const auto& [own, list] : triangles) by_color_.try_emplace(own, surface_, list, numbers_);
    }
    const auto found = by_color_.find(color);
    return found == by_color_.end() ? nullptr : &found->second;
  }

  const Surface& surface_;
  std::vector<uint32_t> numbers_;
  Colors colors_;
  std::map<uint32_t, Target> by_color_;
  std::optional<Target> everything_;
  std::optional<std::vector<std::vector<Triangle>>> patches_;
};

}  // namespace

struct DistanceMeter::State {
  State(const Surface& surface, Colors kind) : colors(kind), source(surface, number_all(surface), kind) {}

  std::vector<uint32_t> number_all(const Surface& surface) {
    std::vector<uint32_t> result;
    result.reserve(surface.points.size());
    numbers.reserve(surface.points.size());
    for (const glm::ivec3& point : surface.points) {
      result.push_back(numbers.try_emplace(point, static_cast<uint32_t>(numbers.size())).first->second);
    }
    return result;
  }

  std::vector<uint32_t> number_other(const Surface& surface) const {
    std::vector<uint32_t> result;
    result.reserve(surface.points.size());
    auto next = static_cast<uint32_t>(numbers.size());
    for (const glm::ivec3& point : surface.points) {
      const auto found = numbers.find(point);
      result.push_back(found != numbers.end() ? found->second : next++);
    }
    return result;
  }

  Numbers numbers;
  Colors colors;
  Side source;
};

DistanceMeter::DistanceMeter(const Surface& source, Colors colors)
    : state_(std::make_unique<State>(source, colors)) {}
DistanceMeter::~DistanceMeter() = default;

double DistanceMeter::bound(const Surface& other, const DistanceEffort& effort) {
  Side side(other, state_->number_other(other), state_->colors);
  double lower = 0;
  double bound = side.distance_to(state_->source, effort, lower);
  bound = std::max(bound, state_->source.distance_to(side, effort, lower));
  return std::min(effort.known, bound > 0 ? bound + rounding_allowance : 0);
}

double distance_bound(const Surface& a, const Surface& b, Colors colors, const DistanceEffort& effort) {
  return DistanceMeter(a, colors).bound(b, effort);
}

}  // namespace triptych
