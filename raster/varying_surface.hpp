// Triangles whose colours differ from pixel to pixel, or that have light of their own.
#pragma once

#include "raster/corner_colors.hpp"
#include "raster/corner_lighting.hpp"
#include "raster/surface_texture.hpp"
#include "scene/effects.hpp"

#include <array>
#include <cstdint>
#include <optional>

namespace triptych {

using Rgba = std::array<uint8_t, 4>;

/// What makes a pixel's colour more than one that its whole triangle has: the first of these that does.
enum class ShadeKind : uint8_t { textured, emissive, colored, lit, bent, capped };
inline constexpr std::array all_shade_kinds = {ShadeKind::textured, ShadeKind::emissive, ShadeKind::colored,
                                               ShadeKind::lit,      ShadeKind::bent,     ShadeKind::capped};

/// Which of them a triangle has, but for caps.
struct SurfaceKinds {
  bool colored = false, textured = false, emissive = false;
  bool baked = false;     ///< baked light in place of the fixed one
  bool occluded = false;  ///< ambient occlusion of the fixed one
  bool bends = false;     ///< CornerLights::bends
  bool smooth = false;    ///< with normals of the model's files, bending or not: alone it makes no kind
  bool lit() const { return baked || occluded; }
  bool any() const { return colored || textured || emissive || lit() || bends; }
  ShadeKind first() const {
    return textured   ? ShadeKind::textured
           : emissive ? ShadeKind::emissive
           : colored  ? ShadeKind::colored
           : lit()    ? ShadeKind::lit
                      : ShadeKind::bent;
  }
};

/// Plain, so that arrays of it cost nothing before they are used.
struct VaryingSurface {
  SurfaceKinds kinds;
  InterpolatedColors
      colors;  ///< where it is coloured, lit or bends; not times `lit`, if it bends, has a texture or is lit
  CornerLighting baked;             ///< where it is lit
  SurfaceTexture texture;           ///< where it is textured
  float base[3];                    ///< where it is not coloured, 0 to 1
  float lit;                        ///< what colours are multiplied by where it does not bend
  const SurfaceMaterial* material;  ///< where it is textured or emissive
  bool transparent;

  /// At the centre of a pixel, and how much it covers there: all of it, where it is not transparent.
  /// light_from: direction, eye space.
  Rgba at(const TextureLevels& levels, const glm::vec3& light_from, int32_t x, int32_t y) const;
};

}  // namespace triptych
