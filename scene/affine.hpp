// Affine transforms of models and meshes.
#pragma once

#include "scene/box.hpp"

#include <glm/mat4x3.hpp>
#include <glm/vec4.hpp>

namespace triptych {

/// An affine transform: columns x, y, z and translation; mesh space to model space.
using Affine = glm::dmat4x3;

/// A box that holds the eight corners of this one under the transform.
inline Box placed_box(const Affine& transform, const Box& box) {
  Box placed;
  for (int corner = 0; corner < 8; ++corner) placed.extend(transform * glm::dvec4(box.corner(corner), 1));
  return placed;
}

}  // namespace triptych
