// The scene `textured` (tests/support/scenes.hpp), and what it is made of.
#pragma once

#include "model/model.hpp"

#include <cstdint>

namespace triptych::scenes {

Model textured();

/// Places on textures by where corners are: so many repetitions a unit along x and z, and along y and z.
void add_coordinates(Mesh& mesh, double repeats);

}  // namespace triptych::scenes
