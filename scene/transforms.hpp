// What a transform does to lengths and to numbers.
#pragma once

#include "scene/affine.hpp"

namespace triptych {

/// Between these, products of six lengths are finite and, down to a lattice step, do not underflow.
inline constexpr double max_coordinate = 1e50, min_extent = 1e-40;

/// Whether all entries are numbers below max_coordinate.
bool is_finite(const Affine& transform);

/// The largest factor by which the transform stretches a length.
double largest_stretch(const Affine& transform);

/// Whether floats can place a mesh under it to within a small multiple of their own precision: the product of
/// the matrix's absolute values and its inverse's is bounded (Skeel, Scaling for numerical stability, 1979).
/// Turned and stretched meshes are near 1; shears and what flattens a mesh are far above.
bool well_conditioned(const Affine& transform, double max_condition);

}  // namespace triptych
