// A triangle that has holes where its texture says so.
#pragma once

#include "raster/surface_texture.hpp"
#include "raster/triangle.hpp"

namespace triptych {

struct CutOutTriangle {
  WindowTriangle window;
  SurfaceTexture texture;
  const TextureLevels* levels;
  SamplePlace sample;  ///< where pixels are looked at

  bool is_solid(int32_t x, int32_t y) const {
    const glm::dvec2 place = glm::dvec2(x + 0.5, y + 0.5) + sample.pixels();
    return texture.is_solid(*levels, place.x, place.y);
  }
};

}  // namespace triptych
