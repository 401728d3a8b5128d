// Simplification by edge collapses with a known error each: levels have a bound by construction, which need
// not be measured.
#pragma once

#include "simplify/collapse.hpp"
#include "simplify/shrinking_mesh.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

/// Reduces any surface to fewer and fewer triangles. Points never move; some are removed, but no locked ones.
///
/// Collapses are done roughly in the order of the bound that they lead to. Of the neighbours that a point may
/// move to, those nearest to the planes of its triangles are tried first (Garland and Heckbert, Surface
/// simplification using quadric error metrics, 1997; without accumulated quadrics, as Lindstrom and Turk,
/// Fast and memory efficient polygonal simplification, 1998, since the bound accumulates the error).
class EdgeCollapse {
 public:
  EdgeCollapse(const Surface& surface, std::span<const uint8_t> locked,
               const LayeredPlanes& planes = LayeredPlanes::none());

  size_t triangle_count() const { return mesh_.triangle_count(); }
  /// The bound of the two-sided distance to the original surface, material by material; lattice steps; never
  /// shrinks.
  double bound() const { return bound_; }
  /// The size of the largest layered plane that a point has left; the bound is no smaller.
  double planes_left() const { return planes_left_; }
  /// Collapses until at most `triangles` are left, or no collapse is possible, or the next one's bound would
  /// be larger than `max_bound`. Returns false if no collapse is possible.
  bool reduce_to(size_t triangles, double max_bound);
  /// Triangles beyond the second at edges of the original surface (except edges with an end that has more
  /// triangles than Star::max_spokes).
  size_t crowded_triangles() const { return crowded_triangles_; }
  /// What is left. Sources: indices into the points of the original surface.
  Piece piece() const { return mesh_.piece(); }
  /// For each triangle of that piece a bound of its points' distance from points of its material in the
  /// original surface.
  std::vector<double> errors() const { return mesh_.errors(); }

 private:
  struct Waiting {
    float cost;
    uint32_t point;
    bool operator<(const Waiting& other) const {  // for a heap with the cheapest on top
      return cost != other.cost ? cost > other.cost : point > other.point;
    }
  };
  void push(const Waiting& waiting);
  void set_cost(uint32_t point, const Collapse& collapse);
  void changed(uint32_t point, double error, double cost);
  void look_again(double cost);
  void spread_disturbance();

  ShrinkingMesh mesh_;
  std::span<const uint8_t> locked_;
  Collapser collapser_;
  std::vector<Waiting> waiting_;
  std::vector<uint32_t> targets_;  ///< for each point where it would move if nothing changed around it
  std::vector<float> costs_;  ///< for each point what its collapse is expected to cost; negative: impossible
  /// For each point the cost of its valid queue entry; its other entries are void.
  std::vector<float> queued_;
  std::vector<float> steps_;        ///< for each point how much its own collapse adds to the errors before it
  std::vector<uint8_t> disturbed_;  ///< for each point whether its star changed since that evaluation
  double bound_ = 0, planes_left_ = 0;
  size_t crowded_triangles_ = 0;
  bool was_looked_at_ = false;
  double longest_ = 0;      ///< the largest addition to a cost for an edge's length
  double looked_at_ = 0;    ///< the cost at which all points without a possible collapse were last evaluated,
  size_t looked_with_ = 0;  ///< and the number of triangles then
};

}  // namespace triptych
