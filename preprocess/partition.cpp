#include "preprocess/partition.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace triptych {

namespace {

/// One of the items to split: its position and its index.
struct Item {
  glm::dvec3 center;
  uint32_t index;
};

/// Moves the items of the lower half to the front and returns how many they are; at least one on each side.
size_t split(std::span<Item> items) {
  Box centers;
  for (const Item& item : items) centers.extend(item.center);
  const int axis = centers.longest_axis();
  const double middle = (centers.lo[axis] + centers.hi[axis]) / 2;
  // A split at the middle keeps parts compact; it is used if neither side gets less than a quarter.
  const auto above = std::stable_partition(items.begin(), items.end(),
                                           [&](const Item& item) { return item.center[axis] < middle; });
  const auto below = static_cast<size_t>(above - items.begin());
  if (below >= items.size() / 4 && below <= items.size() - items.size() / 4 && below > 0 &&
      below < items.size()) {
    return below;
  }
  const size_t half = items.size() / 2;
  std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(half), items.end(),
                   [&](const Item& a, const Item& b) {
                     return a.center[axis] != b.center[axis] ? a.center[axis] < b.center[axis]
                                                             : a.index < b.index;
                   });
  return half;
}

/// Splits until `fits`; parts come out in the order of a depth-first walk, each in ascending order of its
/// indices.
template <typename Fits>
std::vector<std::vector<uint32_t>> partition(std::vector<Item> items, const Fits& fits) {
  std::vector<std::vector<uint32_t>> parts;
  std::vector<std::span<Item>> waiting;
  if (!items.empty()) waiting.push_back(items);
  while (!waiting.empty()) {
    const std::span<Item> part = waiting.back();
    waiting.pop_back();
    if (part.size() == 1 || fits(part)) {
      auto& indices = parts.emplace_back();
      for (const Item& item : part) indices.push_back(item.index);
      std::sort(indices.begin(), indices.end());
    } else {
      const size_t below = split(part);
      waiting.push_back(part.subspan(below));
      waiting.push_back(part.first(below));
    }
  }
  return parts;
}

}  // namespace

std::vector<std::vector<uint32_t>> partition_triangles(const Surface& surface,
                                                       const PartitionLimits& limits) {
  std::vector<Item> items(surface.triangles.size());
  for (uint32_t i = 0; i < items.size(); ++i) {
    glm::dvec3 sum{0};
    for (const uint32_t vertex : surface.triangles[i].vertices) sum += glm::dvec3(surface.points[vertex]);
    items[i] = {sum / 3.0, i};
  }
  return partition(std::move(items), [&](std::span<const Item> part) {
    if (part.size() > limits.triangles) return false;
    if (part.size() <= limits.large_triangles) return true;
    LatticeBox box;
    for (const Item& item : part) {
      for (const uint32_t vertex : surface.triangles[item.index].vertices) box.extend(surface.points[vertex]);
    }
    return glm::length(glm::dvec3(box.hi) - glm::dvec3(box.lo)) <= limits.diagonal;
  });
}

std::vector<std::vector<uint32_t>> partition_objects(std::span<const ObjectExtent> objects,
                                                     std::span<const uint32_t> group, uint64_t triangles) {
  std::vector<Item> items;
  for (const uint32_t index : group) {
    items.push_back({center(objects[index].box), index});
  }
  return partition(std::move(items), [&](std::span<const Item> part) {
    uint64_t count = 0;
    for (const Item& item : part) count += objects[item.index].triangles;
    return count <= triangles;
  });
}

}  // namespace triptych
