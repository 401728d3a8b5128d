#include "raster/triangle_shader.hpp"

#include "raster/instruction_set.hpp"
#include "visibility/shading.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

namespace triptych {

namespace {

uint8_t to_byte(float channel) { return static_cast<uint8_t>(std::rint(channel * 255.0f)); }

/// So that products neither overflow nor vanish.
glm::vec3 scaled(const glm::vec3& v) {
  const float most = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return most > 0 ? v / most : v;
}

/// Of no certain length.
glm::vec3 normal_of(const SlotTable::Triangle& shown) {
  const RasterChunk& chunk = *shown.range->chunk;
  const uint32_t from = chunk.corner[0][shown.triangle];
  // Differences of lattice points are exact.
  const auto edge = [&](uint32_t to) {
    const auto x = static_cast<float>(chunk.x[to] - chunk.x[from]),
               y = static_cast<float>(chunk.y[to] - chunk.y[from]),
               z = static_cast<float>(chunk.z[to] - chunk.z[from]);
    const auto along = [&](const glm::vec4& row) { return (row.x * x + row.y * y) + row.z * z; };
    const PlacedLattice& placed = shown.range->placed;
    return glm::vec3(along(placed.rows[0]), along(placed.rows[1]), along(placed.rows[2]));
  };
  return glm::cross(scaled(edge(chunk.corner[1][shown.triangle])),
                    scaled(edge(chunk.corner[2][shown.triangle])));
}

/// What makes it one of unit length; 0 of one without a direction.
float to_unit(const glm::vec3& normal) {
  const float length = std::sqrt((normal.x * normal.x + normal.y * normal.y) + normal.z * normal.z);
  return length > 0 ? 1.0f / length : 0.0f;
}

}  // namespace

TriangleShader::TriangleShader(const FrameView& view, const TextureLevels& textures)
    : palette_(view.skeleton->palette),
      materials_(view.skeleton->materials),
      textures_(textures),
      light_(light_direction(view)),
      stage_(view),
      caps_(view),
      hatching_(view.view().height),
      width_(view.view().width),
      height_(view.view().height),
      vertex_colors_(view.state.effects.has(Effect::vertex_colors)),
      smooth_normals_(view.state.effects.has(Effect::smooth_normals)),
      shows_textures_(view.state.effects.has(Effect::textures)),
      shows_emission_(view.state.effects.has(Effect::emission)),
      shows_baked_(view.state.effects.has(Effect::baked_light) &&
                   calls_for(view.skeleton->effects, Effect::baked_light)),
      shows_ambient_(view.state.effects.has(Effect::ambient) &&
                     calls_for(view.skeleton->effects, Effect::ambient)) {}

Rgba TriangleShader::to_bytes(const glm::vec3& color) {
  return {to_byte(color.x), to_byte(color.y), to_byte(color.z), 255};
}

glm::vec3 TriangleShader::base(const SlotTable::Triangle& shown) const {
  const std::array<uint8_t, 4>& base = palette_[shown.range->chunk->color[shown.triangle]];
  return glm::vec3(base[0], base[1], base[2]) / 255.0f;
}

Rgba TriangleShader::cap(const glm::vec3& base, uint32_t side, int32_t x, int32_t y) const {
  const glm::vec3 lit = base * caps_.light(side);
  if (!hatching_.inked(x, y, side)) return to_bytes(lit);
  const CapInk ink = cap_ink(base);
  return to_bytes(lit * ink.scale + ink.add);
}

Rgba TriangleShader::cap(const InterpolatedColors& varying, uint32_t side, int32_t x, int32_t y) const {
  float color[3];
  varying.base_at(x, y, color);
  return cap(glm::vec3(color[0], color[1], color[2]), side, x, y);
}

ChunkNormals TriangleShader::normals_shown(const SlotTable::Triangle& shown) const {
  const RasterChunk& chunk = *shown.range->chunk;
  if (chunk.vertex_normal.empty() || !has_normal(chunk.vertex_normal[chunk.corner[0][shown.triangle]]))
    return ChunkNormals::none;
  const bool off = chunk.normals_from == ChunkNormals::of_files && !smooth_normals_;
  return off ? ChunkNormals::none : chunk.normals_from;
}

TriangleShader::Look TriangleShader::look(const SlotTable::Triangle& shown) const {
  const RasterChunk& chunk = *shown.range->chunk;
  Look look;
  const ChunkNormals normals = normals_shown(shown);
  if (normals != ChunkNormals::none) {
    look.lights = corner_normals(shown, light_);
  } else {
    look.lights.light = facet_light(shown);
  }
  look.kinds.colored = vertex_colors_ && !chunk.vertex_color.empty();
  look.kinds.bends = look.lights.bends;
  look.kinds.smooth = normals == ChunkNormals::of_files;
  if (!chunk.light.empty() && has_light(chunk.light[chunk.corner[0][shown.triangle]])) {
    look.kinds.baked = shows_baked_;
    look.kinds.occluded = shows_ambient_ && !shows_baked_;
  }
  if (materials_.empty()) return look;
  const SurfaceMaterial& material = materials_[chunk.color[shown.triangle]];
  look.kinds.emissive = shows_emission_ && material.is_emissive();
  look.kinds.textured = shows_textures_ && !chunk.coordinates.empty() &&
                        (material.texture != SurfaceMaterial::no_texture ||
                         (look.kinds.emissive && material.emission_texture != SurfaceMaterial::no_texture));
  return look;
}

VaryingSurface TriangleShader::varying(const SlotTable::Triangle& shown, const Look& look) const {
  const RasterChunk& chunk = *shown.range->chunk;
  const bool bends = look.lights.bends;
  const glm::vec3 own = base(shown);
  VaryingSurface surface;
  surface.kinds = look.kinds;
  surface.lit = look.lights.light;
  const bool is_lit = surface.kinds.lit();
  if (surface.kinds.colored || is_lit || bends) {
    const CornerBase of_corners{look.kinds.colored, look.kinds.colored ? glm::vec3(0) : own};
    surface.colors = interpolate_colors(stage_, width_, height_, shown, of_corners,
                                        bends || surface.kinds.textured || is_lit ? 1.0f : surface.lit,
                                        bends ? &look.lights : nullptr);
  }
  if (is_lit) surface.baked = lighting(shown, look);
  for (int k = 0; k < 3; ++k) surface.base[k] = own[k];
  surface.transparent = shown.range->transparent;
  surface.material = materials_.empty() ? nullptr : &materials_[chunk.color[shown.triangle]];
  if (surface.kinds.textured) {
    surface.texture = surface_texture(stage_, width_, height_, shown.range->placed, chunk, shown.triangle,
                                      *surface.material);
  }
  return surface;
}

CornerLighting TriangleShader::lighting(const SlotTable::Triangle& shown, const Look& look) const {
  CornerLighting lighting = corner_lighting(shown);
  if (!look.kinds.occluded || look.lights.bends) return lighting;
  if (normals_shown(shown) == ChunkNormals::none) {
    lighting.parts = parts_of_light(normal(shown), light_);
    return lighting;
  }
  for (const glm::vec3& eye : look.lights.eye) {
    const LightParts own = parts_of_light(eye, light_);
    lighting.parts.directed += own.directed / 3.0f;
    lighting.parts.ambient += own.ambient / 3.0f;
  }
  return lighting;
}

glm::vec3 TriangleShader::normal(const SlotTable::Triangle& shown) {
  const glm::vec3 normal = normal_of(shown);
  return normal * to_unit(normal);
}

float TriangleShader::facet_light(const SlotTable::Triangle& shown) const {
  const glm::vec3 normal = normal_of(shown);
  const float scale = to_unit(normal);
  const float towards = (normal.x * light_.x + normal.y * light_.y) + normal.z * light_.z;
  return (ambient_light + diffuse_light * std::abs(towards * scale)) +
         head_light * std::abs(normal.z * scale);
}

KeptShades::KeptShades(const SlotTable& table, const TriangleShader& shader)
    : table_(table), shader_(shader) {
  for (uint32_t place = 0; place < count; ++place) slots_[place] = even_slots_[place] = no_slot(place);
}

Rgba KeptShades::of(uint32_t slot, int32_t x, int32_t y) {
  const uint32_t place = place_of(slot);
  const auto cap = capped_[place] ? shader_.caps().entry(x, y) : std::nullopt;
  const SurfaceKinds& kinds = kinds_[place];
  if (cap && !kinds.colored) return shader_.cap(table_.find(slot), cap->side, x, y);
  if (!kinds.any()) return std::bit_cast<Rgba>(colors_[place]);
  Varying& varying = varying_[slot % varying_count];
  if (!varying_is_set_[slot % varying_count] || varying.slot != slot) {
    varying_is_set_[slot % varying_count] = true;
    const SlotTable::Triangle shown = table_.find(slot);
    varying = {slot, shader_.varying(shown, shader_.look(shown))};
  }
  return cap ? shader_.cap(varying.surface.colors, cap->side, x, y) : shader_.color(varying.surface, x, y);
}

uint32_t KeptShades::place_of(uint32_t slot) {
  const uint32_t place = slot % count;
  if (slots_[place] != slot) {
    const SlotTable::Triangle shown = table_.find(slot, range_);
    const TriangleShader::Look look = shader_.look(shown);
    kinds_[place] = look.kinds;
    capped_[place] = Caps::show(shown);
    colors_[place] = look.varies() ? 0 : std::bit_cast<uint32_t>(shader_.color(shown, look));
    smooth_triangles_ += look.kinds.smooth;
    slots_[place] = slot;
    even_slots_[place] = kinds_[place].any() || capped_[place] ? no_slot(place) : slot;
  }
  if (is_changing(place)) varying_kinds_ |= 1u << static_cast<uint32_t>(kind_at(place));
  return place;
}

SlotColors KeptShades::known() {
  return {.background = std::bit_cast<uint32_t>(background_bytes),
          .kept_slots = even_slots_.data(),
          .kept_colors = colors_.data(),
          .kept_mask = count - 1,
          .context = this,
          .of_slot = [](void* context, uint32_t slot) {
            return std::bit_cast<uint32_t>(static_cast<KeptShades*>(context)->of(slot));
          }};
}

[[gnu::noinline]] void shade_row(std::span<const uint32_t> depths, std::span<const uint32_t> slots,
                                 KeptShades& recent, Rgba* row) {
  recent.begin_row();
  if (const RasterKernels* const kernels = raster_kernels(instruction_set())) {
    kernels->color_row(recent.known(), depths.data(), slots.data(), static_cast<int32_t>(depths.size()), row);
  } else {
    for (size_t x = 0; x < depths.size(); ++x)
      row[x] = depths[x] == 0 ? background_bytes : recent.of(slots[x]);
  }
}

}  // namespace triptych
