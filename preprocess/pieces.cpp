#include "preprocess/pieces.hpp"

#include "preprocess/object_extent.hpp"
#include "preprocess/partition.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <limits>
#include <numeric>
#include <utility>

namespace triptych {

namespace {

/// The cost of testing one more box, in triangles.
constexpr double box_cost = 4;
/// A surface is divided into about this many bundles before the search for pairs, whose cost grows with their
/// square.
constexpr uint64_t bundles = 64;
/// Connected components are not cut into smaller bundles.
constexpr uint64_t min_triangles = 8;

/// Joins boxes pair by pair.
class Joiner {
 public:
  explicit Joiner(std::vector<Box> boxes)
      : boxes_(std::move(boxes)),
        joined_(boxes_.size()),
        rises_(boxes_.size() * boxes_.size()),
        best_(boxes_.size()) {
    for (const Box& box : boxes_) areas_.push_back(half_area(box));
    std::iota(joined_.begin(), joined_.end(), 0u);
    alive_ = joined_;
    for (const uint32_t i : alive_) {
      for (uint32_t other = 0; other < i; ++other) set_rise(i, other);
    }
    for (const uint32_t i : alive_) find_best(i);
  }

  /// Joins while there are more than `most` boxes, or two whose join raises the area by less than `rise`.
  void run(size_t most, double rise) {
    while (alive_.size() > 1) {
      const uint32_t first = *std::min_element(alive_.begin(), alive_.end(), [&](uint32_t a, uint32_t b) {
        return best_[a].rise != best_[b].rise ? best_[a].rise < best_[b].rise : a < b;
      });
      if (alive_.size() <= most && best_[first].rise >= rise) break;
      join(first, best_[first].other);
    }
  }

  /// For each of the original boxes the first of those that it was joined with.
  uint32_t group(uint32_t box) const {
    while (joined_[box] != box) box = joined_[box];
    return box;
  }
  size_t groups() const { return alive_.size(); }

 private:
  struct Best {
    double rise = std::numeric_limits<double>::max();
    uint32_t other = 0;
  };
  double& rise(uint32_t a, uint32_t b) { return rises_[a * boxes_.size() + b]; }
  /// Stores by how much the area rises when one box replaces both; triangles in both count once.
  void set_rise(uint32_t a, uint32_t b) {
    const Box &first = boxes_[a], &second = boxes_[b];
    const Box joint{glm::min(first.lo, second.lo), glm::max(first.hi, second.hi)},
        common{glm::max(first.lo, second.lo), glm::min(first.hi, second.hi)};
    rise(a, b) = rise(b, a) =
        half_area(joint) - areas_[a] - areas_[b] + (common.empty() ? 0 : half_area(common));
  }
  void find_best(uint32_t i) {
    best_[i] = {};
    for (const uint32_t other : alive_) {
      if (other != i && rise(i, other) < best_[i].rise) best_[i] = {rise(i, other), other};
    }
  }
  void join(uint32_t a, uint32_t b) {
    const auto [kept, gone] = std::minmax(a, b);
    boxes_[kept].extend(boxes_[gone]);
    areas_[kept] = half_area(boxes_[kept]);
    joined_[gone] = kept;
    alive_.erase(std::find(alive_.begin(), alive_.end(), gone));
    for (const uint32_t i : alive_) {
      if (i != kept) set_rise(i, kept);
    }
    for (const uint32_t i : alive_) {
      if (i == kept || best_[i].other == kept || best_[i].other == gone) find_best(i);
    }
  }

  std::vector<Box> boxes_;
  std::vector<uint32_t> joined_, alive_;
  std::vector<double> areas_;
  std::vector<double> rises_;  ///< for each pair of boxes
  std::vector<Best> best_;
};

/// For each triangle the number of its connected component.
std::vector<uint32_t> components_of(const Surface& surface, uint32_t& count) {
  DisjointSets connected = connected_points(surface);
  std::vector<uint32_t> numbers(surface.points.size(), no_id), components;
  for (const Triangle& triangle : surface.triangles) {
    uint32_t& number = numbers[connected.root(triangle.vertices[0])];
    if (number == no_id) number = count++;
    components.push_back(number);
  }
  return components;
}

/// What pieces are joined from: triangles of one component, or, where there are many, small components that
/// are near each other.
class Bundles {
 public:
  explicit Bundles(const Surface& surface) : of_triangles(surface.triangles.size()) {
    uint32_t count = 0;
    const std::vector<uint32_t> components = components_of(surface, count);
    std::vector<ObjectExtent> triangles, extents(count);
    std::vector<std::vector<uint32_t>> members(count);
    for (uint32_t i = 0; i < surface.triangles.size(); ++i) {
      ObjectExtent& triangle = triangles.emplace_back();
      for (const uint32_t vertex : surface.triangles[i].vertices)
        triangle.box.extend(glm::dvec3(surface.points[vertex]));
      triangle.triangles = 1;
      ObjectExtent& component = extents[components[i]];
      component.box.extend(triangle.box);
      ++component.triangles;
      members[components[i]].push_back(i);
    }
    const uint64_t share = surface.triangles.size() / bundles;
    std::vector<uint32_t> small;
    for (uint32_t i = 0; i < count; ++i) {
      if (extents[i].triangles <= std::max(share, min_triangles)) {
        small.push_back(i);
        continue;
      }
      for (const auto& part : partition_objects(triangles, members[i], std::max(share, min_triangles))) {
        boxes.emplace_back();
        for (const uint32_t triangle : part) add(triangle, triangles);
      }
    }
    for (const auto& group : partition_objects(extents, small, small.size() > bundles ? share : 0)) {
      boxes.emplace_back();
      for (const uint32_t component : group) {
        for (const uint32_t triangle : members[component]) add(triangle, triangles);
      }
    }
  }

  std::vector<Box> boxes;
  std::vector<uint32_t> of_triangles;  ///< for each triangle the index of its bundle

 private:
  void add(uint32_t triangle, const std::vector<ObjectExtent>& triangles) {
    of_triangles[triangle] = static_cast<uint32_t>(boxes.size() - 1);
    boxes.back().extend(triangles[triangle].box);
  }
};

}  // namespace

std::vector<uint8_t> fitting_pieces(const Surface& surface) {
  const size_t count = surface.triangles.size();
  if (static_cast<double>(count) <= 2 * box_cost) return {};
  Bundles apart(surface);
  Box whole;
  for (const Box& box : apart.boxes) whole.extend(box);
  std::vector<uint32_t> numbers(apart.boxes.size(), no_id);
  Joiner joiner(std::move(apart.boxes));
  joiner.run(max_pieces, half_area(whole) * box_cost / static_cast<double>(count));
  if (joiner.groups() == 1) return {};
  std::vector<uint8_t> pieces;
  uint32_t next = 0;
  for (const uint32_t bundle : apart.of_triangles) {
    uint32_t& number = numbers[joiner.group(bundle)];
    if (number == no_id) number = next++;
    pieces.push_back(static_cast<uint8_t>(number));
  }
  return pieces;
}

EncodedChunk encode(const Surface& surface, bool in_pieces, Palette palette, std::span<const uint32_t> runs) {
  return EncodedChunk(make_chunk(surface, in_pieces ? fitting_pieces(surface) : std::vector<uint8_t>{}), runs,
                      palette);
}

}  // namespace triptych
