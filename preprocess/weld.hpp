// From triangles on a lattice to a surface: equal points are merged, triangles without area dropped.
#pragma once

#include "preprocess/to_lattice.hpp"
#include "simplify/surface.hpp"

#include <cstdint>
#include <span>

namespace triptych {

struct Welded {
  Surface surface;
  uint64_t dropped_triangles = 0;   ///< degenerate on the lattice, or the same triangle a second time
  uint64_t welded_vertices = 0;     ///< vertices that were merged with another one
  uint64_t enlarged_triangles = 0;  ///< triangles that would have lost a corner or more
  uint64_t lone_triangles = 0;      ///< of those: triangles that would have left nothing at all
};

/// Corners at the same point become one point. Of triangles with the same corners and winding the first
/// stays, whatever their colour. A triangle that has an area in its mesh and none on the lattice is dropped
/// if its corners belong to other triangles, and otherwise enlarged: two of its corners are moved by at most
/// a step (with_area()). So no triangle is further than that from what is left of it. Deterministic. Welded
/// vertices are not counted here: corners are not the file's vertices. Where two colours meet at one point it
/// stays one point, and the corners keep their colours, normals and places on textures, if they have such
/// streams.
Welded weld(std::span<const LatticeTriangle> triangles, const CornerStreams& streams);

/// A whole mesh, transformed and rounded to the lattice.
Welded weld(const Mesh& mesh, const Affine& transform, const Lattice& lattice, const MeshColors& colors);

}  // namespace triptych
