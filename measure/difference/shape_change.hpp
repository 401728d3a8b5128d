// What became of a shape: it stayed, or was moved, recoloured, or made another.
#pragma once

#include "measure/difference/object_shapes.hpp"

namespace triptych {

struct ShapeChange {
  bool moved = false;      ///< the same shape elsewhere, or turned
  bool recolored = false;  ///< of a shape that is another: other colours occur in it
  bool reshaped = false;   ///< other triangles, also where they make the same surface
  glm::dvec3 offset{0};    ///< of the middle of its box, where it was moved; model units
  double turned = 0;       ///< by how many degrees, where it was moved

  bool any() const { return moved || recolored || reshaped; }
};

/// Triangles are the same if their corners are within the tolerances of both shapes, whichever way they are
/// turned or wound and however often they are there; of two that differ in colours alone the shape was
/// recoloured. Triangles so thin that the lattice may have swallowed them count neither way. A shape was
/// moved if a translation, or a turn that maps a triangle of it to one of the other's, maps all of it.
ShapeChange compare_shapes(const PlacedShape& before, const PlacedShape& after);

}  // namespace triptych
