// What an effect took part in, in one frame.
#pragma once

#include "scene/effects.hpp"

#include <cstdint>

namespace triptych {

/// Counts are of one frame; `variants` of all that were compiled so far.
struct EffectUse {
  Effect effect = Effect::vertex_colors;
  double ms = 0;                  ///< wall clock
  uint64_t draws = 0;             ///< draw commands, or stretches of triangles, that only it asks for
  uint64_t binds = 0;             ///< of programs, buffers and textures
  uint64_t upload_bytes = 0;      ///< to device memory
  uint64_t fragments = 0;         ///< that it has blended, or pixels that it has shaded
  uint64_t variants = 0;          ///< of shaders
  uint64_t simulation_steps = 0;  ///< how many moving things were evaluated for the frame's time
  uint64_t splits = 0;  ///< how often lists of fragments were made in parts, to stay within their cap
};

}  // namespace triptych
