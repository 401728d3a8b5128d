// What colours of the palette have besides: textures, holes, light of their own.
#pragma once

#include "scene/texture.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace triptych {

struct Skeleton;

/// Of one colour of the palette; 16 bytes, as a pack holds it.
struct SurfaceMaterial {
  static constexpr uint32_t no_texture = 0xffffffffu;

  uint32_t texture = no_texture;           ///< multiplies the colour in linear light; into Skeleton::textures
  uint32_t emission_texture = no_texture;  ///< multiplies the emission, at the same coordinates
  std::array<uint8_t, 3> emission = {};    ///< light of its own, as displayed (sRGB)
  uint8_t cutoff = 0;   ///< where the texture's alpha is less, of 255, there is a hole; 0: nowhere
  uint8_t alpha = 255;  ///< multiplies the texture's alpha, where the palette's colour is transparent
  TextureSampler sampler;
  bool operator==(const SurfaceMaterial&) const = default;

  bool is_textured() const { return texture != no_texture || emission_texture != no_texture; }
  bool is_emissive() const { return emission != std::array<uint8_t, 3>{}; }
};
static_assert(sizeof(SurfaceMaterial) == 16);

/// The section MATL. Empty bytes where the skeleton has no materials.
std::vector<std::byte> encode_materials(const Skeleton& skeleton);
/// Fills Skeleton::materials and Skeleton::textures. Error (place) for bytes that end too soon or too late,
/// and for what names a colour or a texture that is not there, or lies outside the section of texels, which
/// has texel_bytes.
void decode_materials(std::span<const std::byte> bytes, uint64_t texel_bytes, const std::string& place,
                      Skeleton& skeleton);

}  // namespace triptych
