// Which triangle of a drawable is at a pixel.
#pragma once

#include "scene/camera.hpp"
#include "scene/pack.hpp"

#include <cstdint>
#include <optional>

namespace triptych {

struct PixelHit {
  uint32_t placement = 0;  ///< of the drawable's, counted from its first one
  uint32_t triangle = 0;   ///< of the chunk that it places
};

/// The nearest triangle of the drawable behind the near plane on the ray through the middle of pixel x, y,
/// counted from the left and the top, in double; nothing where the ray hits none, which can happen at the
/// edges of triangles where the device drew one. Reads the drawable's chunks.
std::optional<PixelHit> hit_at(const Pack& pack, DrawableId drawable, const View& view, int x, int y);

}  // namespace triptych
