#include "simplify/distance.hpp"

#include "base/disjoint_sets.hpp"
#include "simplify/key_hash.hpp"
#include "simplify/one_sided.hpp"

#include <algorithm>
#include <array>
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

/// Corners of cuts are rounded; this is far above any rounding error and far below what is visible.
constexpr double rounding_allowance = 1e-5;
/// Where the bound is not tight after this many cuts per triangle on average, it stays larger than necessary,
/// but correct.
constexpr size_t cuts_per_triangle = 6;
/// All triangles share this many more: a few of them may lie over the whole other surface.
constexpr size_t cuts_beyond = 2000;
/// About this many points, spread over the surface, are measured before all others.
constexpr size_t first_points = 61;

using TriangleSet = tsl::robin_set<std::array<uint32_t, 3>, KeyHash, KeyEqual>;

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

  const TriangleTree& tree() const { return tree_; }
  bool has(const std::array<uint32_t, 3>& triangle) const { return triangles_.contains(triangle); }
  bool has(uint32_t point) const { return points_.contains(point); }

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

/// Triangles of one colour that are connected by their points, or all triangles where colours do not count.
struct Patch {
  std::vector<uint32_t> triangles;
  /// Its distance if the other surface has lost its colour.
  double diagonal = std::numeric_limits<double>::infinity();
};

double diagonal(const Surface& surface, std::span<const uint32_t> triangles) {
  LatticeBox box;
  for (const uint32_t triangle : triangles) {
    for (const uint32_t vertex : surface.triangles[triangle].vertices) box.extend(surface.points[vertex]);
  }
  return glm::length(glm::dvec3(box.hi) - glm::dvec3(box.lo));
}

std::vector<Patch> patches_of(const Surface& surface, Colors colors) {
  std::vector<Patch> result;
  if (colors == Colors::ignore) {
    auto& all = result.emplace_back().triangles;
    all.resize(surface.triangles.size());
    std::iota(all.begin(), all.end(), 0u);
    return result;
  }
  std::map<uint32_t, std::vector<uint32_t>> by_color;
  for (uint32_t i = 0; i < surface.triangles.size(); ++i)
    by_color[surface.triangles[i].material].push_back(i);
  std::unordered_map<uint32_t, size_t> places;
  for (const auto& [color, triangles] : by_color) {
    DisjointSets connected(surface.points.size());
    for (const uint32_t i : triangles) {
      const auto& vertices = surface.triangles[i].vertices;
      for (const uint32_t vertex : vertices) connected.join(vertex, vertices[0]);
    }
    places.clear();
    for (const uint32_t i : triangles) {
      const auto [found, inserted] =
          places.try_emplace(connected.root(surface.triangles[i].vertices[0]), result.size());
      if (inserted) result.emplace_back();
      result[found->second].triangles.push_back(i);
    }
  }
  for (Patch& patch : result) patch.diagonal = diagonal(surface, patch.triangles);
  return result;
}

/// One of the two surfaces that are compared; search structures are built when they are first needed.
class Side {
 public:
  /// `numbers`: for each point one that equal points of both surfaces share.
  Side(const Surface& surface, std::vector<uint32_t> numbers, Colors colors)
      : surface_(surface), numbers_(std::move(numbers)), colors_(colors) {}

  /// The one-sided distance; raises `lower` to what is reached. Each patch is compared with its own colour,
  /// or with all colours plus the patch's own size. `known`: for each triangle a bound of its own; none if
  /// empty.
  double distance_to(Side& to, std::span<const double> known, const DistanceEffort& effort, double& lower) {
    if (patches_.empty()) patches_ = patches_of(surface_, colors_);
    // Corners first: the sooner a large distance is known, the fewer cuts are needed. A few spread over the
    // surface come before all others.
    for (const size_t stride : {surface_.triangles.size() / first_points + 1, size_t{1}}) {
      if (reach_corners(to, stride, effort, lower)) return effort.known;
    }
    double bound = 0;
    for (const Patch& patch : patches_) {
      const double largest = std::max(patch.diagonal, lower);
      double own = std::numeric_limits<double>::infinity(), own_lower = lower;
      if (const Target* target = to.target(color_of(patch))) {
        own = bound_of(patch, *target, known, effort, own_lower);
      }
      if (own <= largest) {
        lower = own_lower;
      } else {
        own = std::min(own, std::max(patch.diagonal, bound_of(patch, to.everything(), known, effort, lower)));
        lower = std::max(lower, std::min(patch.diagonal, own));
      }
      bound = std::max(bound, own);
      if (bound >= effort.known) return effort.known;
    }
    return bound;
  }

 private:
  uint32_t color_of(const Patch& patch) const { return surface_.triangles[patch.triangles[0]].material; }

  /// Raises `lower` to the distances of corners of every `stride`-th triangle of each patch; true once the
  /// known bound is tight.
  bool reach_corners(Side& to, size_t stride, const DistanceEffort& effort, double& lower) {
    size_t next = 0, passed = 0;
    for (const Patch& patch : patches_) {
      const size_t end = passed + patch.triangles.size();
      const Target* target = next < end ? to.target(color_of(patch)) : nullptr;
      if (target) {
        OneSided side(target->tree(), lower, effort.tightness);
        for (; next < end; next += stride) {
          lower = std::max(lower, std::min(side.lower(), patch.diagonal));
          if (effort.known <= enough(lower, effort.tightness)) return true;
          const Triangle& triangle = surface_.triangles[patch.triangles[next - passed]];
          for (const uint32_t vertex : triangle.vertices) {
            if (!target->has(numbers_[vertex])) side.reach(glm::dvec3(surface_.points[vertex]));
          }
        }
        lower = std::max(lower, std::min(side.lower(), patch.diagonal));
      }
      while (next < end) next += stride;
      passed = end;
    }
    return false;
  }

  double bound_of(const Patch& patch, const Target& target, std::span<const double> known,
                  const DistanceEffort& effort, double& lower) const {
    OneSided side(target.tree(), lower, effort.tightness);
    std::vector<uint32_t> changed;
    for (const uint32_t i : patch.triangles) {
      if (!target.has(numbered(surface_.triangles[i], numbers_))) changed.push_back(i);
    }
    const auto known_of = [&](uint32_t i) { return known.empty() ? effort.known : known[i]; };
    // Those that may be far are looked at first.
    if (!known.empty()) {
      std::stable_sort(changed.begin(), changed.end(),
                       [&](uint32_t a, uint32_t b) { return known[a] > known[b]; });
    }
    for (const uint32_t i : changed) side.add(corners_of(surface_, surface_.triangles[i]), known_of(i));
    const size_t share = cuts_beyond * patch.triangles.size() / surface_.triangles.size();
    const double bound = side.finish(cuts_per_triangle * changed.size() + share, effort.known);
    lower = side.lower();
    return std::min(bound, effort.known);
  }

  Target& everything() {
    if (!everything_) everything_.emplace(surface_, surface_.triangles, numbers_);
    return *everything_;
  }

  /// Null if there is nothing of that colour.
  const Target* target(uint32_t color) {
    if (colors_ == Colors::ignore) return &everything();
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
  std::vector<Patch> patches_;
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
  double bound = state_->source.distance_to(side, {}, effort, lower);
  if (bound < effort.known)
    bound = std::max(bound, side.distance_to(state_->source, effort.known_each, effort, lower));
  return std::min(effort.known, bound > 0 ? bound + rounding_allowance : 0);
}

double distance_bound(const Surface& a, const Surface& b, Colors colors, const DistanceEffort& effort) {
  return DistanceMeter(a, colors).bound(b, effort);
}

}  // namespace triptych
