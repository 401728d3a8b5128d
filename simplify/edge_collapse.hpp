// Simplification by edge collapses, each of which knows how far it moves the surface: the bound comes with
// the levels and need not be measured.
#pragma once

#include "simplify/collapse.hpp"
#include "simplify/shrinking_mesh.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

/// Takes any surface to fewer and fewer triangles. Points stay where they are: they only become fewer, and
/// those that are locked stay.
///
/// Collapses go in the order of the bound that they would lead to, near enough: of the neighbours that a
/// point may move to, those come first that are nearest to the planes of its triangles (Garland and Heckbert,
/// Surface simplification using quadric error metrics, 1997; without memory, as Lindstrom and Turk, Fast and
/// memory efficient polygonal simplification, 1998, since the bound remembers).
class EdgeCollapse {
 public:
  EdgeCollapse(const Surface& surface, std::span<const uint8_t> locked);

  size_t triangle_count() const { return mesh_.triangle_count(); }
  /// Of the two-sided distance to the surface that this began with, for each material by itself; lattice
  /// steps; never shrinks.
  double bound() const { return bound_; }
  /// Collapses until at most so many triangles are left, or no collapse is possible, or the next one's bound
  /// would be larger than `max_bound`; false in the second case.
  bool reduce_to(size_t triangles, double max_bound);
  /// Triangles beyond the second at an edge of the surface that this began with (but for edges of which one
  /// end has more triangles than a star can order).
  size_t crowded_triangles() const { return crowded_triangles_; }
  /// What is left. Sources: indices into the points of the surface that this began with.
  Piece piece() const { return mesh_.piece(); }
  /// For each triangle of that piece how far its points are at most from points of its material there.
  std::vector<double> errors() const { return mesh_.errors(); }

 private:
  struct Waiting {
    float cost;
    uint32_t point;
    bool operator<(const Waiting& other) const {  // of a heap whose top is the cheapest
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
  std::vector<uint32_t> targets_;  ///< for each point where it would go if nothing changed around it
  std::vector<float> costs_;   ///< for each point what its collapse is expected to cost; negative: impossible
  std::vector<float> queued_;  ///< with what cost it is in the queue; other places there are void
  std::vector<float> steps_;   ///< how much of the cost its own collapse adds to what was before
  std::vector<uint8_t> disturbed_;  ///< for each point whether its star changed since all were looked at
  double bound_ = 0;
  size_t crowded_triangles_ = 0;
  bool was_looked_at_ = false;
  double longest_ = 0;      ///< what the longest edge there may be adds to a cost
  double looked_at_ = 0;    ///< the cost at which all points that waited for nothing were last looked at,
  size_t looked_with_ = 0;  ///< and the number of triangles then
};

}  // namespace triptych
