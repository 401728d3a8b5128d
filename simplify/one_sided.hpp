// How far convex pieces are from a set of triangles at most: branch and bound.
#pragma once

#include "simplify/convex_polygon.hpp"
#include "simplify/triangle_tree.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace triptych {

/// A bound up to here needs no more work where so much is reached: it is at most `tightness` times that, or
/// nobody can see it.
double enough(double reached, double tightness);

/// The largest distance of triangles from those of a tree (as Tang, Lee and Kim, Interactive Hausdorff
/// distance computation for general polygonal models, 2009): the piece with the largest bound is cut until
/// that bound is nearly reached by some point, or the work is no longer worth it.
///
/// The distance from a convex set is a convex function, so a piece is nowhere further from one triangle of
/// the tree than at its corners. The cuts follow the edges of the tree's triangles, so that a flat region
/// costs as many pieces as triangles overlap in it.
class OneSided {
 public:
  /// `lower` is a distance that is reached somewhere: below it nothing needs to be known exactly. The bound
  /// is to be at most `tightness` times what is reached.
  OneSided(const TriangleTree& tree, double lower, double tightness)
      : tree_(tree), lower_(lower), tightness_(tightness) {}

  /// Raises what is known to be reached if the point is further off.
  void reach(const glm::dvec3& point);
  /// What is known to be reached.
  double lower() const { return lower_; }

  /// A triangle that is to be bounded. `known`: a bound that holds for it.
  void add(const Corners& triangle, double known);
  /// The bound of all that was added, after so many cuts at most; there is no need to be below `known`.
  double finish(size_t max_cuts, double known);

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
