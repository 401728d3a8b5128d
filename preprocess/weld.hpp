// From triangles on a lattice to a surface: equal points merge, triangles without area go.
#pragma once

#include "preprocess/to_lattice.hpp"
#include "simplify/surface.hpp"

#include <cstdint>
#include <span>

namespace triptych {

struct Welded {
  Surface surface;
  uint64_t dropped_triangles = 0;   ///< degenerate on the lattice, or the same triangle a second time
  uint64_t welded_vertices = 0;     ///< vertices that took the place of another one
  uint64_t enlarged_triangles = 0;  ///< a corner or more would have vanished
  uint64_t lone_triangles = 0;      ///< of those: nothing would have been left where they are
};

/// Corners at the same point become one point. Two triangles with the same corners in the same turn are one,
/// whatever their colour: the first stays. What has an area where it comes from and none on the lattice is
/// dropped where its corners belong to other triangles, and otherwise enlarged: two of its corners are moved
/// by a step at most (with_area()). So nothing is further from what is left of it. Deterministic. Welded
/// vertices are not counted: corners are not the file's vertices.
Welded weld(std::span<const LatticeTriangle> triangles);

/// A whole mesh, transformed and rounded to the lattice. `colors` gives the palette index of each material.
Welded weld(const Mesh& mesh, const Affine& transform, const Lattice& lattice,
            std::span<const uint32_t> colors);

}  // namespace triptych
