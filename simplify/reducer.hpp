// The seam behind which simplifiers differ.
#pragma once

#include "simplify/layered_planes.hpp"
#include "simplify/simplify.hpp"
#include "simplify/surface.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace triptych {

struct Reduced {
  Piece piece;  ///< sources: indices into the points of the surface that the reducer began with
  /// The bound of the two-sided distance to that surface, material by material, if the simplifier gives one.
  std::optional<double> bound;
  /// The same for the points of each triangle; empty if the simplifier gives none.
  std::vector<double> errors;
  bool further = false;  ///< whether max_bound alone prevented further reduction
  /// The size of the largest layered plane that a point has left: the bound may not be smaller.
  double planes_left = 0;
};

/// Reduces a surface to fewer and fewer triangles. Points never move; some are removed.
class Reducer {
 public:
  virtual ~Reducer() = default;
  /// Reduces to at most `triangles`, or as few as possible; simplifiers with a bound do not go beyond
  /// `max_bound`. `triangles` must decrease from call to call.
  virtual Reduced reduce_to(size_t triangles, double max_bound) = 0;
  /// Triangles of the surface that meet the others in a way that half-edges cannot express.
  virtual size_t detached_triangles() const { return 0; }
};

/// `locked`, if not empty, says for each point whether it must stay. The surface holds at least one triangle;
/// all are kept by reference. Surfaces whose corners have colours are always collapsed: the other
/// simplifiers do not know of them. Of layered planes meshoptimizer does not know either: with it points that
/// lie in one, and those beside them, stay where they are. OpenMesh keeps them there, however large the
/// error.
std::unique_ptr<Reducer> make_reducer(Simplifier simplifier, const Surface& surface,
                                      std::span<const uint8_t> locked,
                                      const LayeredPlanes& planes = LayeredPlanes::none());

}  // namespace triptych
