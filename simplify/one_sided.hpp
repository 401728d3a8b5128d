// An upper bound of the distance of convex pieces from a set of triangles, by branch and bound.
#pragma once

#include "simplify/convex_polygon.hpp"
#include "simplify/triangle_tree.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace triptych {

/// A bound up to this value needs no more work if a distance of `reached` is known to occur: it is at most
/// `tightness` times that, or too small to be visible.
double enough(double reached, double tightness);

/// The largest distance of triangles from those of a tree (as Tang, Lee and Kim, Interactive Hausdorff
/// distance computation for general polygonal models, 2009): the piece with the largest bound is cut until
/// some point nearly reaches that bound, or the number of cuts is used up.
///
/// The distance from a convex set is a convex function, so over a piece the distance from one triangle of the
/// tree is largest at a corner. The cuts follow the edges of the tree's triangles, so that a flat region
/// costs as many pieces as triangles overlap in it.
class OneSided {
 public:
  /// `lower`: a distance that some point is known to have; smaller ones need not be exact. The bound should
  /// be at most `tightness` times the largest distance known to occur.
  OneSided(const TriangleTree& tree, double lower, double tightness)
      : tree_(tree), lower_(lower), tightness_(tightness) {}

  /// Measures the point; raises lower() if it is further away.
  void reach(const glm::dvec3& point);
  /// The largest distance that is known to occur.
  double lower() const { return lower_; }

  /// Adds a triangle to be bounded. `known`: a valid bound for it.
  void add(const Corners& triangle, double known);
  /// The bound for all that was added, after at most `max_cuts`; it need not be below `known`. Ends where the
  /// distance is known to be above `most`.
  double finish(size_t max_cuts, double known, double most = std::numeric_limits<double>::infinity());

 private:
  struct Waiting {
    double bound;
    uint32_t near;  ///< the triangle near its middle
    ConvexPolygon polygon;
    bool operator<(const Waiting& other) const { return bound < other.bound; }
  };

  double enough() const { return triptych::enough(lower_, tightness_); }
  bool is_tight(double bound) const { return bound <= enough(); }
  void add(const ConvexPolygon& polygon, double known);
  void divide(const Waiting& piece);
  void halve(const Waiting& piece);

  const TriangleTree& tree_;
  double lower_, tightness_, bound_ = 0;
  uint32_t hint_ = 0;
  std::vector<Waiting> waiting_;  ///< a heap
};

}  // namespace triptych
