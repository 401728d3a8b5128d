#include "preprocess/cluster.hpp"

#include "base/disjoint_sets.hpp"
#include "simplify/neighbours.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <tuple>

namespace triptych {

namespace {

struct Edge {
  double weight;
  uint32_t a, b;  ///< a < b
  bool operator<(const Edge& other) const {
    return std::tie(weight, a, b) < std::tie(other.weight, other.a, other.b);
  }
};

/// Disjoint sets of objects, each with what the criterion needs.
class Forest {
 public:
  Forest(std::span<const ObjectExtent> objects, const ClusterLimits& limits)
      : limits_(limits),
        sets_(objects.size()),
        extents_(objects.begin(), objects.end()),
        internal_(objects.size()) {}

  uint32_t root(uint32_t object) { return sets_.root(object); }

  void merge_if_close(const Edge& edge) {
    const uint32_t a = std::min(root(edge.a), root(edge.b)), b = std::max(root(edge.a), root(edge.b));
    if (a == b || edge.weight > tolerated(a) || edge.weight > tolerated(b)) return;
    ObjectExtent joined = extents_[a];
    joined.box.extend(extents_[b].box);
    joined.triangles += extents_[b].triangles;
    if (joined.triangles > limits_.triangles) return;
    if (cost(joined) > limits_.cost * (cost(extents_[a]) + cost(extents_[b]))) return;
    if (volume(joined.box) > limits_.volume * (volume(extents_[a].box) + volume(extents_[b].box))) return;
    sets_.join(a, b);
    extents_[a] = joined;
    internal_[a] = edge.weight;  // edges come in ascending order
  }

 private:
  double tolerated(uint32_t cluster) const {
    const double share =
        static_cast<double>(extents_[cluster].triangles) / static_cast<double>(limits_.triangles);
    return internal_[cluster] + limits_.scale / std::max(share, 1.0 / 64);
  }

  static double cost(const ObjectExtent& cluster) {
    return expected_cost(cluster.box, 1, static_cast<double>(cluster.triangles));
  }
  static double volume(const Box& box) {
    const glm::dvec3 size = box.hi - box.lo;
    return size.x * size.y * size.z;
  }

  const ClusterLimits& limits_;
  DisjointSets sets_;
  std::vector<ObjectExtent> extents_;
  std::vector<double> internal_;
};

std::vector<Edge> edges_between(std::span<const ObjectExtent> objects, uint32_t neighbours) {
  std::vector<glm::dvec3> centers;
  for (const ObjectExtent& object : objects) centers.push_back(center(object.box));
  const auto nearest = nearest_neighbours(centers, neighbours);
  std::vector<Edge> edges;
  for (uint32_t i = 0; i < objects.size(); ++i) {
    for (const uint32_t other : nearest[i]) {
      const Box &a = objects[i].box, &b = objects[other].box;
      const double gap = glm::length(glm::max(glm::max(a.lo - b.hi, b.lo - a.hi), glm::dvec3(0)));
      edges.push_back(
          {gap + 0.1 * glm::distance(centers[i], centers[other]), std::min(i, other), std::max(i, other)});
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

}  // namespace

std::vector<std::vector<uint32_t>> cluster_objects(std::span<const ObjectExtent> objects,
                                                   const ClusterLimits& limits) {
  Forest forest(objects, limits);
  for (const Edge& edge : edges_between(objects, limits.neighbours)) forest.merge_if_close(edge);
  std::vector<std::vector<uint32_t>> clusters;
  std::vector<size_t> cluster_of(objects.size());
  for (uint32_t i = 0; i < objects.size(); ++i) {
    const uint32_t root = forest.root(i);  // the smallest member, so it comes first
    if (root == i) {
      cluster_of[i] = clusters.size();
      clusters.emplace_back();
    }
    clusters[cluster_of[root]].push_back(i);
  }
  return clusters;
}

}  // namespace triptych
