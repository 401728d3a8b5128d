// What moves in the sample `effects`.
#pragma once

#include "samples/gltf_writer.hpp"

#include <cstddef>
#include <cstdint>

namespace triptych {

struct MovingThings {
  size_t objects = 0;
  uint64_t triangles = 0;
};

/// A door with a knob in a frame of its own before the fence, and a fan of four blades at the back wall.
/// moves: whether the door swings, in six seconds, and the fan turns, in two; otherwise they stand, the door
/// closed.
MovingThings add_moving_things(GltfWriter& writer, bool moves);

}  // namespace triptych
