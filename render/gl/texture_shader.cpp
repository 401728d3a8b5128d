#include "render/gl/shaders.hpp"

#include <fmt/core.h>

namespace triptych {

namespace {

// SurfaceMaterial as four words; TextureBuffer's records and texels.
const char* const tables = R"(
struct TextureRecord {{ uint width, height, levels, first; }};
layout(std430, binding = {}) readonly buffer Materials {{ uvec4 materials[]; }};
layout(std430, binding = {}) readonly buffer Textures {{ TextureRecord textures[]; }};
layout(std430, binding = {}) readonly buffer Texels {{ uint texels[]; }};
)";

const char* const conversions = R"(
vec3 linear_of(vec3 shown) {
  return mix(shown / 12.92, pow((shown + 0.055) / 1.055, vec3(2.4)), greaterThan(shown, vec3(0.04045)));
}
vec3 shown_of(vec3 linear) {
  return mix(linear * 12.92, 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, greaterThan(linear, vec3(0.0031308)));
}
)";

// As raster/surface_texture.cpp has it.
const char* const sampling = R"(
const uint no_texture = 0xffffffffu;
uint word(uint material, int i) { return material >> (8 * i) & 255u; }
int wrapped(int i, int size, uint wrap) {
  if (wrap == 2u) return clamp(i, 0, size - 1);
  int period = wrap == 0u ? size : 2 * size;
  int within = i % period;
  within += within < 0 ? period : 0;
  return within < size ? within : 2 * size - 1 - within;
}
vec4 texel_at(uint first, int width, ivec2 at) {
  vec4 texel = unpackUnorm4x8(texels[first + uint(at.y * width + at.x)]);
  return vec4(linear_of(texel.rgb), texel.a);
}
vec4 sample_level(TextureRecord texture, uint level, uvec4 material, vec2 place) {
  ivec2 size = max(ivec2(texture.width, texture.height) >> int(level), ivec2(1));
  uint first = texels[texture.first + level], wrap_u = word(material.w, 1), wrap_v = word(material.w, 2);
  bool nearest = word(material.w, 3) != 0u;
  vec2 at = place * vec2(size) - (nearest ? 0.0 : 0.5);
  ivec2 low = ivec2(floor(at));
  ivec2 a = ivec2(wrapped(low.x, size.x, wrap_u), wrapped(low.y, size.y, wrap_v));
  if (nearest) return texel_at(first, size.x, a);
  ivec2 b = ivec2(wrapped(low.x + 1, size.x, wrap_u), wrapped(low.y + 1, size.y, wrap_v));
  vec2 share = at - floor(at);
  return mix(mix(texel_at(first, size.x, a), texel_at(first, size.x, ivec2(b.x, a.y)), share.x),
             mix(texel_at(first, size.x, ivec2(a.x, b.y)), texel_at(first, size.x, b), share.x), share.y);
}
vec4 sample_texture(uint index, uvec4 material, vec2 place, vec2 right, vec2 up) {
  TextureRecord texture = textures[index];
  vec2 size = vec2(texture.width, texture.height);
  right *= size;
  up *= size;
  float squared = max(dot(right, right), dot(up, up));
  uint last = texture.levels - 1u;
  if (!(squared < 1e30)) return sample_level(texture, last, material, place);
  int exponent = 1;
  float mantissa = squared > 1.0 ? frexp(squared, exponent) : 0.5;
  float level = (float(exponent - 1) + (2.0 * mantissa - 1.0)) / 2.0;
  uint finer = uint(level);
  if (finer >= last) return sample_level(texture, last, material, place);
  vec4 fine = sample_level(texture, finer, material, place);
  float share = level - float(finer);
  return share == 0.0 ? fine : mix(fine, sample_level(texture, finer + 1u, material, place), share);
}
)";

// Before anything is discarded, since derivatives need the whole quad.
const char* const looking_up = R"(
in vec2 texture_place;
vec2 place_right, place_up;
uvec4 surface;
vec4 base_sample = vec4(1.0);
void look_up() {
  place_right = dFdx(texture_place);
  place_up = dFdy(texture_place);
  surface = materials[surface_index];
  if (surface.x != no_texture)
    base_sample = sample_texture(surface.x, surface, texture_place, place_right, place_up);
}
bool is_hole() { return base_sample.a * 255.0 < float(word(surface.z, 3)); }
)";

const char* const plain = R"(
uvec4 surface;
void look_up() { surface = materials[surface_index]; }
bool is_hole() { return false; }
)";

const char* const textured_base = R"(
vec3 base_shown(vec3 base) {
  return surface.x == no_texture ? base : shown_of(linear_of(base) * base_sample.rgb);
}
float covered(float alpha) {
  return surface.x == no_texture ? alpha : base_sample.a * float(word(surface.w, 0)) / 255.0;
}
)";
const char* const plain_base = R"(
vec3 base_shown(vec3 base) { return base; }
float covered(float alpha) { return alpha; }
)";

const char* const glow_of_texture = R"(
vec3 glow() {
  vec3 emission = linear_of(vec3(word(surface.z, 0), word(surface.z, 1), word(surface.z, 2)) / 255.0);
  if (surface.y == no_texture) return emission;
  return emission * sample_texture(surface.y, surface, texture_place, place_right, place_up).rgb;
}
)";
const char* const plain_glow = R"(
vec3 glow() { return linear_of(vec3(word(surface.z, 0), word(surface.z, 1), word(surface.z, 2)) / 255.0); }
)";
const char* const glowing = R"(
vec3 with_glow(vec3 lit) {
  vec3 own = glow();
  return own == vec3(0.0) ? lit : shown_of(min(linear_of(lit) + own, vec3(1.0)));
}
)";
const char* const not_glowing = "vec3 with_glow(vec3 lit) { return lit; }\n";

}  // namespace

std::string material_shader_source(const ShaderVariant& variant) {
  if (!variant.textured && !variant.emissive)
    return (variant.baked ? std::string(conversions) : std::string()) +
           "void look_up() {}\nbool is_hole() { return false; }\n" + plain_base + not_glowing;
  std::string source = "flat in uint surface_index;\n" +
                       fmt::format(fmt::runtime(tables), materials_binding, textures_binding, texels_binding);
  source += conversions;
  if (variant.textured) {
    source += std::string(sampling) + looking_up + textured_base;
  } else {
    source += "uint word(uint material, int i) { return material >> (8 * i) & 255u; }\n" +
              std::string(plain) + plain_base;
  }
  if (!variant.emissive) return source + not_glowing;
  return source + (variant.textured ? glow_of_texture : plain_glow) + glowing;
}

}  // namespace triptych
