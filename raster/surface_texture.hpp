// What a texture shows on a triangle, pixel by pixel, in whole numbers that are the same on every processor.
#pragma once

#include "raster/perspective_weights.hpp"
#include "raster/texture_levels.hpp"
#include "scene/surface_material.hpp"

#include <cstdint>

namespace triptych {

/// Where a pixel looks at a texture.
struct TexturePlace {
  double u, v;  ///< in widths and heights of the texture
  /// How far the next pixel to the right and that above look from there.
  double right_u, right_v, up_u, up_v;
};

/// In linear light, 0 to 65,535, and alpha, 0 to 65,280 (255 · 256).
struct TextureSample {
  uint32_t red, green, blue, alpha;
};

/// What a sample is for: colours show coarser levels where textures have no room; what decides where holes
/// are is exact.
enum class TextureSampling : uint8_t { colors, holes };

/// Between the two levels whose texels are as large as the pixel is there, at most and at least (Williams,
/// Pyramidal parametrics, 1983), and in each between the four texels around the place; or what is nearest.
TextureSample sample(const TextureLevels& levels, uint32_t texture, const TextureSampler& sampler,
                     const TexturePlace& place, TextureSampling sampling = TextureSampling::colors);

/// A triangle with places on a texture. Plain, so that arrays of it cost nothing before they are used.
struct SurfaceTexture {
  PerspectiveWeights weights;
  double u[3], v[3];  ///< of the corners
  const SurfaceMaterial* material;

  /// At a place in the picture, in pixels.
  TexturePlace at(double x, double y) const;
  /// Whether there is none of the holes there.
  bool is_solid(const TextureLevels& levels, double x, double y) const;
};

/// Of a chunk that has coordinates; material: of the triangle.
SurfaceTexture surface_texture(const VertexStage& stage, int width, int height, const PlacedLattice& placed,
                               const RasterChunk& chunk, uint32_t triangle, const SurfaceMaterial& material);

}  // namespace triptych
