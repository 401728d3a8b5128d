#include "lod/preprocess/pieces.hpp"

#include "scene/disjoint_sets.hpp"
#include "scene/object_extent.hpp"
#include "scene/partition.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace triptych {

namespace {

/// What has fewer triangles is not worth two draws.
constexpr size_t least_triangles = static_cast<size_t>(2 * drawable_cost);
/// Components of several are joined by place alone, before the search for pairs, which takes the square.
constexpr uint64_t components_to_join = 32;
/// Of the whole's area, what pieces may have together.
constexpr double share_of_area = 0.8;

/// Joins extents pair by pair.
class Joiner {
 public:
  explicit Joiner(std::vector<ObjectExtent> extents)
      : extents_(std::move(extents)), joined_(extents_.size()), best_(extents_.size()) {
    std::iota(joined_.begin(), joined_.end(), 0u);
    for (uint32_t i = 0; i < extents_.size(); ++i) alive_.push_back(i);
    for (const uint32_t i : alive_) find_best(i);
  }

  void run() {
    while (alive_.size() > 1) {
      const uint32_t first = *std::min_element(alive_.begin(), alive_.end(), [&](uint32_t a, uint32_t b) {
        return best_[a].rise != best_[b].rise ? best_[a].rise < best_[b].rise : a < b;
      });
      if (alive_.size() <= most_pieces && best_[first].rise > 0) break;
      join(first, best_[first].other);
    }
  }

  /// For each of the extents that were given, the first of those that it was joined with.
  uint32_t group(uint32_t extent) const {
    while (joined_[extent] != extent) extent = joined_[extent];
    return extent;
  }
  /// Of all groups together, half.
  double area() const {
    double sum = 0;
    for (const uint32_t i : alive_) sum += half_area(extents_[i].box);
    return sum;
  }
  size_t groups() const { return alive_.size(); }

 private:
  struct Best {
    double rise = std::numeric_limits<double>::max();  ///< of the expected cost
    uint32_t other = 0;
  };
  static double cost(const ObjectExtent& extent) {
    return expected_cost(extent.box, 1, static_cast<double>(extent.triangles));
  }
  static ObjectExtent join(ObjectExtent a, const ObjectExtent& b) {
    a.box.extend(b.box);
    a.triangles += b.triangles;
    return a;
  }
  void find_best(uint32_t i) {
    best_[i] = {};
    for (const uint32_t other : alive_) {
      if (other == i) continue;
      const double rise =
          cost(join(extents_[i], extents_[other])) - cost(extents_[i]) - cost(extents_[other]);
      if (rise < best_[i].rise) best_[i] = {rise, other};
    }
  }
  void join(uint32_t a, uint32_t b) {
    const auto [kept, gone] = std::minmax(a, b);
    extents_[kept] = join(extents_[kept], extents_[gone]);
    joined_[gone] = kept;
    alive_.erase(std::find(alive_.begin(), alive_.end(), gone));
    for (const uint32_t i : alive_) {
      if (i == kept || best_[i].other == kept || best_[i].other == gone) find_best(i);
    }
  }

  std::vector<ObjectExtent> extents_;
  std::vector<uint32_t> joined_, alive_;
  std::vector<Best> best_;
};

}  // namespace

std::vector<Surface> fitting_pieces(const Surface& surface) {
  if (surface.triangles.size() < least_triangles) return {};

  DisjointSets connected(surface.points.size());
  for (const Triangle& triangle : surface.triangles) {
    for (const uint32_t vertex : triangle.vertices) connected.join(vertex, triangle.vertices[0]);
  }
  std::vector<uint32_t> index(surface.points.size());  // of a component's first point: which component it is
  std::vector<ObjectExtent> extents;
  Box box;
  for (uint32_t point = 0; point < surface.points.size(); ++point) {
    const uint32_t root = connected.root(point);
    if (root == point) {
      index[point] = static_cast<uint32_t>(extents.size());
      extents.emplace_back();
    }
    const glm::dvec3 position(surface.points[point]);
    extents[index[root]].box.extend(position);
    box.extend(position);
  }
  if (extents.size() == 1) return {};
  for (const Triangle& triangle : surface.triangles)
    ++extents[index[connected.root(triangle.vertices[0])]].triangles;

  std::vector<uint32_t> all(extents.size()), bundle(extents.size());
  std::iota(all.begin(), all.end(), 0u);
  std::vector<ObjectExtent> bundles;
  const uint64_t bundle_triangles =
      extents.size() > components_to_join ? surface.triangles.size() / components_to_join : 0;
  for (const auto& members : partition_objects(extents, all, bundle_triangles)) {
    for (const uint32_t member : members) {
      bundle[member] = static_cast<uint32_t>(bundles.size());
    }
    ObjectExtent& joint = bundles.emplace_back();
    for (const uint32_t member : members) {
      joint.box.extend(extents[member].box);
      joint.triangles += extents[member].triangles;
    }
  }
  Joiner joiner(std::move(bundles));
  joiner.run();
  if (joiner.groups() == 1 || joiner.area() > share_of_area * half_area(box)) return {};

  std::vector<Surface> pieces;
  std::vector<std::vector<Triangle>> groups(extents.size());
  for (const Triangle& triangle : surface.triangles) {
    groups[joiner.group(bundle[index[connected.root(triangle.vertices[0])]])].push_back(triangle);
  }
  for (const auto& triangles : groups) {
    if (!triangles.empty()) pieces.push_back(extract(surface.points, triangles).surface);
  }
  return pieces;
}

}  // namespace triptych
