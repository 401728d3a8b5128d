// Simplification by meshoptimizer (Arseny Kapoulkine): edge collapses in the order of quadric errors, in
// single precision.
#pragma once

#include "simplify/surface.hpp"

#include <cstdint>
#include <span>

namespace triptych {

/// At most `triangles`, or as few as meshoptimizer can reach. Lines where colours meet stay closed; points
/// where more than two colours or sheets meet, and the locked ones, stay where they are. Returns the surface
/// unchanged where a locked point would be lost. Piece::sources: indices into its points.
Piece simplify_with_meshopt(const Surface& surface, std::span<const uint8_t> locked, size_t triangles);

}  // namespace triptych
