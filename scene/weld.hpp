// From a mesh in doubles to a surface on a lattice: equal points merge, triangles without area go.
#pragma once

#include "scene/lattice.hpp"
#include "scene/model.hpp"
#include "scene/surface.hpp"

#include <cstdint>
#include <span>

namespace triptych {

struct Welded {
  Surface surface;
  uint64_t dropped_triangles = 0;  ///< degenerate on the lattice, or the same triangle a second time
  uint64_t welded_vertices = 0;    ///< vertices that took the place of another one
};

/// Rounds the mesh, transformed, to the lattice. `colors` gives the palette index of each material. A
/// transform that mirrors turns the triangles round, so that they keep their outside. Two triangles with the
/// same corners in the same turn are one, whatever their colour: the first stays. Deterministic.
Welded weld(const Mesh& mesh, const Affine& transform, const Lattice& lattice,
            std::span<const uint32_t> colors);

}  // namespace triptych
