#include "preprocess/objects.hpp"

#include "preprocess/cluster.hpp"
#include "preprocess/partition.hpp"

#include <algorithm>
#include <glm/vec4.hpp>
#include <numeric>
#include <utility>

namespace triptych {

namespace {

/// The median of the values, each weighted by its triangles.
double weighted_median(std::vector<std::pair<double, uint64_t>> values) {
  std::sort(values.begin(), values.end());
  uint64_t total = 0, below = 0;
  for (const auto& value : values) total += value.second;
  for (const auto& [value, weight] : values) {
    below += weight;
    if (2 * below >= total) return value;
  }
  return 0;
}

/// The typical size of a region with `leaf_triangles`, found by splitting all parts evenly, whatever their
/// extent. A few very large objects, such as the ground that a building stands on, do not change it, unlike
/// the size of the model's box.
double even_diagonal(std::span<const ObjectExtent> extents, uint64_t leaf_triangles) {
  std::vector<uint32_t> all(extents.size());
  std::iota(all.begin(), all.end(), 0u);
  std::vector<std::pair<double, uint64_t>> places, parts;
  for (const auto& group : partition_objects(extents, all, leaf_triangles)) {
    Box centers;
    uint64_t triangles = 0;
    for (const uint32_t index : group) {
      centers.extend(center(extents[index].box));
      triangles += extents[index].triangles;
    }
    places.push_back({diagonal(centers), triangles});
  }
  for (const ObjectExtent& extent : extents) parts.push_back({diagonal(extent.box), extent.triangles});
  return std::max(weighted_median(std::move(places)), 2 * weighted_median(std::move(parts)));
}

/// Placed parts come instance by instance.
Objects original_objects(const PlacedParts& parts, std::span<const ObjectExtent> extents) {
  Objects objects;
  for (uint32_t i = 0; i < extents.size(); ++i) {
    if (i == 0 || parts.placed[i].instance != parts.placed[i - 1].instance) {
      objects.members.emplace_back();
      objects.extents.emplace_back();
    }
    objects.members.back().push_back(i);
    objects.extents.back().box.extend(extents[i].box);
    objects.extents.back().triangles += extents[i].triangles;
  }
  const uint64_t count = objects.members.size();
  objects.counts = {count, count, count, count};
  return objects;
}

/// Clusters the parts of one hierarchy.
Objects cluster_parts(const PlacedParts& parts, const std::vector<ObjectExtent>& extents,
                      const BuildOptions& options) {
  if (extents.empty()) return {};
  std::vector<uint32_t> small;
  std::vector<ObjectExtent> small_extents;
  std::vector<std::vector<uint32_t>> clusters;
  for (uint32_t i = 0; i < extents.size(); ++i) {
    if (extents[i].triangles <= options.leaf_triangles / 2) {
      small.push_back(i);
      small_extents.push_back(extents[i]);
    } else {
      clusters.push_back({i});
    }
  }
  // Clusters may grow beyond a leaf's size where their shapes fit; the second partition evens them out.
  ClusterLimits limits;
  limits.triangles = uint64_t{options.leaf_triangles} * 2;
  limits.scale = even_diagonal(extents, options.leaf_triangles) / 16;
  for (const auto& cluster : cluster_objects(small_extents, limits)) {
    auto& members = clusters.emplace_back();
    for (const uint32_t index : cluster) members.push_back(small[index]);
  }
  std::sort(clusters.begin(), clusters.end());

  Objects objects;
  for (const auto& cluster : clusters) {
    auto pieces = partition_objects(extents, cluster, options.leaf_triangles);
    std::move(pieces.begin(), pieces.end(), std::back_inserter(objects.members));
  }
  for (const auto& members : objects.members) {
    ObjectExtent& extent = objects.extents.emplace_back();
    for (const uint32_t member : members) {
      extent.box.extend(extents[member].box);
      extent.triangles += extents[member].triangles;
    }
  }
  objects.counts = {parts.instances, parts.placed.size(), clusters.size(), objects.members.size()};
  return objects;
}

/// Adds the placed sub-hierarchies that are not empty.
void add_sub_hierarchies(const PlacedParts& parts, std::span<const Objects> before, Objects& objects) {
  objects.leaves.assign(objects.extents.size(), 1);
  for (uint32_t i = 0; i < parts.sub_hierarchies.size(); ++i) {
    const PlannedSubHierarchy& placed = parts.sub_hierarchies[i];
    ObjectExtent extent;
    for (const ObjectExtent& inner : before[placed.hierarchy].extents) {
      extent.triangles += inner.triangles;
      extent.box.extend(placed_box(parts.transforms[placed.transform], inner.box));
    }
    if (extent.triangles == 0) continue;
    objects.sub_hierarchies.push_back(i);
    objects.extents.push_back(extent);
    const std::vector<uint64_t>& inner = before[placed.hierarchy].leaves;
    objects.leaves.push_back(std::accumulate(inner.begin(), inner.end(), uint64_t{0}));
  }
}

}  // namespace

std::vector<Objects> make_objects(const Parts& parts, const BuildOptions& options) {
  std::vector<Objects> all;
  for (const PlacedParts& placed : parts.hierarchies) {
    std::vector<ObjectExtent> extents(placed.placed.size());
    for (size_t i = 0; i < extents.size(); ++i) {
      extents[i].box = parts.lattices[placed.lattice].box(placed.boxes[i]);
      extents[i].triangles = parts.parts[placed.placed[i].part].triangles;
    }
    all.push_back(options.hierarchy == HierarchyKind::median_split ? original_objects(placed, extents)
                                                                   : cluster_parts(placed, extents, options));
    add_sub_hierarchies(placed, all, all.back());
  }
  return all;
}

}  // namespace triptych
