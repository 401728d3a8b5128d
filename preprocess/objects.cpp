#include "preprocess/objects.hpp"

#include "preprocess/cluster.hpp"
#include "preprocess/partition.hpp"

#include <algorithm>
#include <glm/vec4.hpp>
#include <map>
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

/// The file of a source object; what belongs to none is of the first.
uint32_t file_at(std::span<const uint32_t> file_of, SourceObjectId object) {
  return object < file_of.size() ? file_of[object] : 0;
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

/// Clusters some of a hierarchy's placed parts, `own`, and adds what they become.
void cluster_parts(const std::vector<ObjectExtent>& all, std::span<const uint32_t> own,
                   const BuildOptions& options, Objects& objects) {
  std::vector<ObjectExtent> extents, small_extents;
  std::vector<uint32_t> small;
  std::vector<std::vector<uint32_t>> clusters;
  for (const uint32_t i : own) {
    extents.push_back(all[i]);
    if (all[i].triangles <= options.leaf_triangles / 2) {
      small.push_back(i);
      small_extents.push_back(all[i]);
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
  for (const auto& cluster : clusters) {
    auto pieces = partition_objects(all, cluster, options.leaf_triangles);
    std::move(pieces.begin(), pieces.end(), std::back_inserter(objects.members));
  }
  objects.counts.clusters += clusters.size();
}

/// Clusters the parts of one hierarchy, those of each file by themselves. files: of each placed part; empty
/// where there is one.
Objects cluster_by_file(const PlacedParts& parts, const std::vector<ObjectExtent>& extents,
                        std::span<const uint32_t> files, const BuildOptions& options) {
  std::map<uint32_t, std::vector<uint32_t>> by_file;
  for (uint32_t i = 0; i < extents.size(); ++i) by_file[files.empty() ? 0 : files[i]].push_back(i);
  Objects objects;
  for (const auto& [file, own] : by_file) {
    cluster_parts(extents, own, options, objects);
    if (!files.empty()) objects.files.resize(objects.members.size(), file);
  }
  for (const auto& members : objects.members) {
    ObjectExtent& extent = objects.extents.emplace_back();
    for (const uint32_t member : members) {
      extent.box.extend(extents[member].box);
      extent.triangles += extents[member].triangles;
    }
  }
  objects.counts.initial = parts.instances;
  objects.counts.partition1 = parts.placed.size();
  objects.counts.partition2 = objects.members.size();
  return objects;
}

/// Adds the placed sub-hierarchies that are not empty.
void add_sub_hierarchies(const Motion& motion, const PlacedParts& parts, std::span<const Objects> before,
                         std::span<const uint32_t> file_of, Objects& objects) {
  objects.leaves.assign(objects.extents.size(), 1);
  for (uint32_t i = 0; i < parts.sub_hierarchies.size(); ++i) {
    const PlannedSubHierarchy& placed = parts.sub_hierarchies[i];
    ObjectExtent extent;
    for (const ObjectExtent& inner : before[placed.hierarchy].extents) {
      extent.triangles += inner.triangles;
      extent.box.extend(box_at_all_times(motion, placed, parts.transforms, inner.box));
    }
    if (extent.triangles == 0) continue;
    objects.sub_hierarchies.push_back(i);
    objects.extents.push_back(extent);
    if (placed.joint != no_id) {
      objects.moving.resize(objects.extents.size(), false);
      objects.moving.back() = true;
    }
    if (!file_of.empty()) objects.files.push_back(file_at(file_of, placed.first_object));
    const std::vector<uint64_t>& inner = before[placed.hierarchy].leaves;
    objects.leaves.push_back(std::accumulate(inner.begin(), inner.end(), uint64_t{0}));
  }
  if (!objects.moving.empty()) objects.moving.resize(objects.extents.size(), false);
}

}  // namespace

std::vector<Objects> make_objects(const Parts& parts, const BuildOptions& options,
                                  std::span<const uint32_t> file_of) {
  std::vector<Objects> all;
  for (const PlacedParts& placed : parts.hierarchies) {
    // What repeats is of one file.
    const bool is_joint = &placed == &parts.hierarchies.back() && !file_of.empty() &&
                          options.hierarchy == HierarchyKind::partition_cluster_partition;
    std::vector<ObjectExtent> extents(placed.placed.size());
    std::vector<uint32_t> files;
    for (size_t i = 0; i < extents.size(); ++i) {
      extents[i].box = parts.lattices[placed.lattice].box(placed.boxes[i]);
      extents[i].triangles = parts.parts[placed.placed[i].part].triangles;
      if (is_joint) files.push_back(file_at(file_of, placed.objects[placed.placed[i].instance]));
    }
    all.push_back(options.hierarchy == HierarchyKind::median_split
                      ? original_objects(placed, extents)
                      : cluster_by_file(placed, extents, files, options));
    add_sub_hierarchies(parts.motion, placed, all, is_joint ? file_of : std::span<const uint32_t>(),
                        all.back());
  }
  return all;
}

}  // namespace triptych
