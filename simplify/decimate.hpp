// Simplification by half-edge collapses in the order of quadric errors (Garland and Heckbert, Surface
// simplification using quadric error metrics, 1997), with OpenMesh's decimater.
#pragma once

#include "simplify/layered_planes.hpp"
#include "simplify/surface.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace triptych {

/// Reduces a surface to fewer and fewer triangles. Points never move; some are removed. Borders and lines
/// where colours meet weigh like planes through them, so that shapes and colours keep their outlines.
class Decimation {
 public:
  /// `locked`, if not empty, says for each point whether it must stay. No point leaves a layered plane; those
  /// are kept by reference.
  Decimation(const Surface& surface, std::span<const uint8_t> locked,
             const LayeredPlanes& planes = LayeredPlanes::none());
  ~Decimation();
  Decimation(const Decimation&) = delete;
  Decimation& operator=(const Decimation&) = delete;

  /// Collapses until at most `triangles` are left or no collapse is possible, and returns what is left.
  /// Piece::sources are indices into the points of the surface that this decimation began with.
  Piece reduce_to(size_t triangles);

  /// Triangles connected with the others only by points, since half-edges cannot express how they meet.
  size_t detached_triangles() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace triptych
