// Bottom-up clustering of small objects by proximity: Kruskal's minimum spanning tree with the criterion of
// Felzenszwalb and Huttenlocher, Efficiently computing a good segmentation (section 2.2 of Manocha 2003, step
// 2).
#pragma once

#include "scene/partition.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

struct ClusterLimits {
  uint64_t triangles = 16384;  ///< no cluster of several objects has more
  /// k of the criterion, in units of distance: clusters C1 and C2 merge over an edge of weight w only where
  /// w <= min(Int(C1) + k / |C1|, Int(C2) + k / |C2|); |C| counts triangles in shares of `triangles`, at
  /// least 1/64.
  double scale = 1;
  /// Clusters merge only where that is no dearer to draw than to draw each of them when its box is seen (the
  /// argument of the surface area heuristic, MacDonald and Booth 1990): what a test and a draw cost beside
  /// the triangles, in triangles. Infinite: they merge wherever the other limits let them.
  double drawable_cost = 32;
  /// The surface of a cluster's box is at most so many times that of the smaller one it merges with: what is
  /// small stays small, and is hidden where what is large is not.
  double growth = 4;
  uint32_t neighbours = 12;  ///< edges of each object, to those with the nearest centres
};

/// Groups of indices into `objects`, each object in one group, in ascending order of their first members. The
/// weight of an edge is the gap between the boxes plus a little of the distance of their centres. Ties are
/// broken by index.
std::vector<std::vector<uint32_t>> cluster_objects(std::span<const ObjectExtent> objects,
                                                   const ClusterLimits& limits);

}  // namespace triptych
