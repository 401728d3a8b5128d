// What triangles of a visibility buffer look like: their colours, and their normals.
#pragma once

#include "raster/caps.hpp"
#include "raster/shading_counts.hpp"
#include "raster/varying_surface.hpp"
#include "raster/visibility_buffer.hpp"
#include "visibility/cap_look.hpp"

#include <array>
#include <bit>
#include <bitset>
#include <cstdint>

namespace triptych {

/// Shades triangles under one view: the light of visibility/shading.hpp.
class TriangleShader {
 public:
  /// textures: of the view's pack.
  TriangleShader(const FrameView& view, const TextureLevels& textures);

  /// How a triangle is shaded.
  struct Look {
    SurfaceKinds kinds;
    CornerLights lights = {};  ///< where normals of its corners show; otherwise only the light
    bool varies() const { return kinds.any(); }
  };
  Look look(const SlotTable::Triangle& shown) const;
  /// Of one that does not vary: that of its material.
  Rgba color(const SlotTable::Triangle& shown, const Look& look) const {
    return to_bytes(base(shown) * look.lights.light);
  }
  /// Of one that does at the centre of a pixel, and how much it covers there.
  Rgba color(const VaryingSurface& varying, int32_t x, int32_t y) const {
    return varying.at(textures_, light_, x, y);
  }
  /// Of a cap at a side that shows at a pixel in place of the triangle, with the colours of its corners if it
  /// has any.
  Rgba cap(const SlotTable::Triangle& shown, uint32_t side, int32_t x, int32_t y) const {
    return cap(base(shown), side, x, y);
  }
  Rgba cap(const InterpolatedColors& varying, uint32_t side, int32_t x, int32_t y) const;
  const Caps& caps() const { return caps_; }
  /// By how much it covers what lies behind, from 0 to 1; where it is textured, another alpha says so.
  float alpha(const SlotTable::Triangle& shown) const {
    return static_cast<float>(palette_[shown.range->chunk->color[shown.triangle]][3]) / 255.0f;
  }
  VaryingSurface varying(const SlotTable::Triangle& shown, const Look& look) const;
  /// Of either side, eye space, unit length; 0 of a triangle without area.
  static glm::vec3 normal(const SlotTable::Triangle& shown);

 private:
  static Rgba to_bytes(const glm::vec3& color);
  /// The colour of the material, from 0 to 1.
  glm::vec3 base(const SlotTable::Triangle& shown) const;
  Rgba cap(const glm::vec3& base, uint32_t side, int32_t x, int32_t y) const;
  float facet_light(const SlotTable::Triangle& shown) const;
  CornerLighting lighting(const SlotTable::Triangle& shown, const Look& look) const;
  ChunkNormals normals_shown(const SlotTable::Triangle& shown) const;

  const std::vector<std::array<uint8_t, 4>>& palette_;
  std::span<const SurfaceMaterial> materials_;
  const TextureLevels& textures_;
  glm::vec3 light_;
  VertexStage stage_;
  Caps caps_;
  CapHatching hatching_;
  int width_, height_;
  bool vertex_colors_, smooth_normals_, shows_textures_, shows_emission_, shows_baked_, shows_ambient_;
};

/// The colours of triangles that were shaded a short while ago: most show in the row above, too.
class KeptShades {
 public:
  /// Slots are the table's, which stays as it is.
  KeptShades(const SlotTable& table, const TriangleShader& shader);

  /// Of a triangle whose colours vary no colour, and varying_kinds() has its kind from then on.
  Rgba of(uint32_t slot) { return std::bit_cast<Rgba>(colors_[place_of(slot)]); }
  /// For kernels: those that do not vary.
  SlotColors known();
  /// A bit for each ShadeKind.
  uint32_t varying_kinds() const { return varying_kinds_; }
  /// Triangles with normals of the model's files, bending or not.
  uint64_t smooth_triangles() const { return smooth_triangles_; }
  void begin_row() { varying_kinds_ = 0; }

  /// Whether the colours of the slot's triangle vary, as where caps show in its place; for what reason, if
  /// they do; and what they are at a pixel's centre, with how much is covered there.
  bool varies(uint32_t slot) { return is_changing(place_of(slot)); }
  bool varies(uint32_t slot, ShadeKind kind) {
    const uint32_t place = place_of(slot);
    return is_changing(place) && kind_at(place) == kind;
  }
  SurfaceKinds kinds(uint32_t slot) { return kinds_[place_of(slot)]; }
  Rgba of(uint32_t slot, int32_t x, int32_t y);

 private:
  static constexpr uint32_t count = 1024, varying_count = 256;
  static constexpr uint32_t no_slot(uint32_t place) { return place + 1; }  ///< it belongs to another place
  struct Varying {
    uint32_t slot;
    VaryingSurface surface;
  };
  ShadeKind kind_at(uint32_t place) const {
    return kinds_[place].any() ? kinds_[place].first() : ShadeKind::capped;
  }
  /// Where it stands, now at the latest.
  uint32_t place_of(uint32_t slot);
  /// Whether its colours vary, or it is capped.
  bool is_changing(uint32_t place) const { return slots_[place] != even_slots_[place]; }

  const SlotTable& table_;
  const TriangleShader& shader_;
  std::array<uint32_t, count> slots_, colors_;
  std::array<uint32_t, count>
      even_slots_;  ///< the same slots, without those whose colours vary or that are capped
  std::array<SurfaceKinds, count> kinds_;
  std::bitset<count> capped_;
  size_t range_ = 0;                            ///< where the last slot was found
  std::array<Varying, varying_count> varying_;  // unused, and so not touched, in pictures without any
  std::bitset<varying_count> varying_is_set_;
  uint64_t smooth_triangles_ = 0;
  uint32_t varying_kinds_ = 0;
};

/// Calls with each kind whose bit is set.
template <typename OfKind>
void for_each_kind(uint32_t kinds, const OfKind& of_kind) {
  for (const ShadeKind kind : all_shade_kinds)
    if ((kinds >> static_cast<uint32_t>(kind) & 1) != 0) of_kind(kind);
}

/// Counts the pixels of a row that are of one kind, and adds them and their time to the counts in the end.
class VaryingPixels {
 public:
  VaryingPixels(ShadingCounts& counts, ShadeKind kind)
      : counts_(counts), kind_(static_cast<size_t>(kind)), timed_(counts.varying_ms[kind_]) {}
  ~VaryingPixels() {
    counts_.varying_pixels[kind_] += all_;
    counts_.smooth_pixels[kind_] += smooth_;
    counts_.colored_pixels += colored_;
    counts_.emissive_pixels += emissive_;
    counts_.baked_pixels += baked_;
    counts_.occluded_pixels += occluded_;
  }
  VaryingPixels(const VaryingPixels&) = delete;
  VaryingPixels& operator=(const VaryingPixels&) = delete;
  void add(const SurfaceKinds& kinds) {
    ++all_;
    smooth_ += kinds.smooth;
    colored_ += kinds.colored;
    emissive_ += kinds.emissive;
    baked_ += kinds.baked;
    occluded_ += kinds.occluded;
  }

 private:
  ShadingCounts& counts_;
  size_t kind_;
  TimedShading timed_;
  uint64_t all_ = 0, smooth_ = 0, colored_ = 0, emissive_ = 0, baked_ = 0, occluded_ = 0;
};

/// The colours of a row's pixels, background where nothing is. Those whose colours vary get none: recent says
/// of which kinds there are any.
void shade_row(std::span<const uint32_t> depths, std::span<const uint32_t> slots, KeptShades& recent,
               Rgba* row);

}  // namespace triptych
