#include "raster/varying_surface.hpp"

#include "scene/linear_light.hpp"

#include <algorithm>
#include <cmath>

namespace triptych {

namespace {

uint8_t to_byte(float channel) { return static_cast<uint8_t>(std::rint(channel * 255.0f)); }

/// A colour as displayed, 0 to 1, under an irradiance of which 1 shows white as white.
uint8_t under(const LinearLight& light, float displayed, float irradiance) {
  const float linear = static_cast<float>(light.of(to_byte(displayed))) * irradiance;
  return light.displayed(
      static_cast<uint32_t>(std::rint(std::min(linear, static_cast<float>(LinearLight::most)))));
}

/// The product of a colour as displayed, 0 to 1, and one in linear light, as displayed.
float product(const LinearLight& light, float displayed, uint32_t linear) {
  const uint64_t whole = uint64_t{light.of(to_byte(displayed))} * linear;
  constexpr uint32_t most = LinearLight::most;
  return static_cast<float>(light.displayed(static_cast<uint32_t>((whole + most / 2) / most))) / 255.0f;
}

}  // namespace

Rgba VaryingSurface::at(const TextureLevels& levels, const glm::vec3& light_from, int32_t x,
                        int32_t y) const {
  const LinearLight& light = LinearLight::table();
  float color[3] = {base[0], base[1], base[2]};
  float own_light = lit;
  if (kinds.colored || kinds.lit() || kinds.bends) {
    const float bent_light = colors.at(x, y, light_from, color);
    if (kinds.bends) own_light = bent_light;
  }
  Rgba shown = {0, 0, 0, transparent && kinds.textured ? material->alpha : uint8_t{255}};
  std::array<uint32_t, 3> glow = {};
  if (kinds.emissive)
    for (size_t k = 0; k < 3; ++k) glow[k] = light.of(material->emission[k]);
  if (kinds.textured) {
    const TexturePlace place = texture.at(x + 0.5, y + 0.5);
    if (material->texture != SurfaceMaterial::no_texture) {
      const TextureSample own = sample(levels, material->texture, material->sampler, place);
      const uint32_t channels[3] = {own.red, own.green, own.blue};
      for (size_t k = 0; k < 3; ++k) color[k] = product(light, color[k], channels[k]);
      constexpr uint32_t most = 255 * 256;
      if (transparent) shown[3] = static_cast<uint8_t>((own.alpha * material->alpha + most / 2) / most);
    }
    if (kinds.emissive && material->emission_texture != SurfaceMaterial::no_texture) {
      const TextureSample own = sample(levels, material->emission_texture, material->sampler, place);
      const uint32_t channels[3] = {own.red, own.green, own.blue};
      for (size_t k = 0; k < 3; ++k) glow[k] = glow[k] * channels[k] / LinearLight::most;
    }
  }
  CornerLighting::At there{};
  if (kinds.lit()) {
    there = baked.at(colors.weights, x, y);
    if (kinds.occluded) {
      const LightParts parts = kinds.bends ? parts_of_light(colors.normal_at(x, y), light_from) : baked.parts;
      own_light = parts.directed + parts.ambient * there.openness;
    }
  }
  const bool is_lit = kinds.colored && !kinds.textured && !kinds.bends && !kinds.lit();
  for (size_t k = 0; k < 3; ++k) {
    shown[k] = kinds.baked ? under(light, color[k], there.irradiance[k])
                           : to_byte(is_lit ? color[k] : color[k] * own_light);
    if (glow[k] > 0) shown[k] = light.displayed(std::min(LinearLight::most, light.of(shown[k]) + glow[k]));
  }
  return shown;
}

}  // namespace triptych
