// Simplification by half-edge collapses in the order of quadric errors (Garland and Heckbert, Surface
// simplification using quadric error metrics, 1997), with OpenMesh's decimater.
#pragma once

#include "simplify/surface.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace triptych {

/// Takes a surface to fewer and fewer triangles. Points stay where they are: they only become fewer. Lines
/// where a surface ends or colours meet weigh like planes through them, so that shapes and colours keep their
/// outlines.
class Decimation {
 public:
  /// `locked`, if not empty, says for each point whether it must stay.
  Decimation(const Surface& surface, std::span<const uint8_t> locked);
  ~Decimation();
  Decimation(const Decimation&) = delete;
  Decimation& operator=(const Decimation&) = delete;

  /// Collapses until at most so many triangles are left or no collapse is possible, and gives what is left.
  /// Piece::sources are indices into the points of the surface that this decimation began with.
  Piece reduce_to(size_t triangles);

  /// Triangles that hang together with the others only by their points: half-edges cannot express how they
  /// meet.
  size_t detached_triangles() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace triptych
