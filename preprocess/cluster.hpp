// Bottom-up clustering of small objects by proximity: Kruskal's minimum spanning tree with the criterion of
// Felzenszwalb and Huttenlocher, Efficiently computing a good segmentation (section 2.2 of Manocha 2003, step
// 2).
#pragma once

#include "preprocess/object_extent.hpp"

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
  /// Clusters merge only where their common box has at most `cost` times their expected_cost() and at most
  /// `volume` times their volume: the content of a box that is mostly air would often be drawn without being
  /// seen.
  double cost = 1, volume = 1.5;
  uint32_t neighbours = 12;  ///< edges of each object, to those with the nearest centres
};

/// Groups of indices into `objects`, each object in one group, in ascending order of their first members. The
/// weight of an edge is the gap between the boxes plus a little of the distance of their centres. Ties are
/// broken by index.
std::vector<std::vector<uint32_t>> cluster_objects(std::span<const ObjectExtent> objects,
                                                   const ClusterLimits& limits);

}  // namespace triptych
