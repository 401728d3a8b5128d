// Affine transforms of models and meshes.
#pragma once

#include <glm/mat4x3.hpp>

namespace triptych {

/// An affine transform: columns x, y, z and translation; mesh space to model space.
using Affine = glm::dmat4x3;

}  // namespace triptych
