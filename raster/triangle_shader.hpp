// What triangles of a visibility buffer look like: their colours, and their normals.
#pragma once

#include "raster/caps.hpp"
#include "raster/corner_colors.hpp"
#include "raster/shading_counts.hpp"
#include "raster/visibility_buffer.hpp"
#include "visibility/cap_look.hpp"

#include <array>
#include <bit>
#include <bitset>
#include <cstdint>

namespace triptych {

using Rgba = std::array<uint8_t, 4>;

/// Shades triangles under one view: the light of visibility/shading.hpp.
class TriangleShader {
 public:
  explicit TriangleShader(const FrameView& view);

  /// How a triangle is shaded.
  struct Look {
    bool colors = false;                        ///< with the colours of its corners
    ChunkNormals normals = ChunkNormals::none;  ///< with the normals of its corners
    CornerLights lights = {};                   ///< then; otherwise only the light
    bool varies() const { return colors || lights.bends; }
  };
  Look look(const SlotTable::Triangle& shown) const;
  /// Of one that does not vary.
  Rgba color(const SlotTable::Triangle& shown, const Look& look) const {
    return to_bytes(base(shown) * look.lights.light);
  }
  /// Of one that does at the centre of a pixel.
  Rgba color(const InterpolatedColors& varying, int32_t x, int32_t y) const;
  /// Of a cap at a side that shows at a pixel in place of the triangle, with the colours of its corners if it
  /// has any.
  Rgba cap(const SlotTable::Triangle& shown, uint32_t side, int32_t x, int32_t y) const {
    return cap(base(shown), side, x, y);
  }
  Rgba cap(const InterpolatedColors& varying, uint32_t side, int32_t x, int32_t y) const;
  const Caps& caps() const { return caps_; }
  /// By how much it covers what lies behind, from 0 to 1.
  float alpha(const SlotTable::Triangle& shown) const {
    return static_cast<float>(palette_[shown.range->chunk->color[shown.triangle]][3]) / 255.0f;
  }
  InterpolatedColors varying(const SlotTable::Triangle& shown, const Look& look) const;
  /// Of either side, eye space, unit length; 0 of a triangle without area.
  static glm::vec3 normal(const SlotTable::Triangle& shown);

 private:
  static Rgba to_bytes(const glm::vec3& color);
  /// The colour of the material, from 0 to 1.
  glm::vec3 base(const SlotTable::Triangle& shown) const;
  Rgba cap(const glm::vec3& base, uint32_t side, int32_t x, int32_t y) const;
  float facet_light(const SlotTable::Triangle& shown) const;
  ChunkNormals normals_shown(const SlotTable::Triangle& shown) const;

  const std::vector<std::array<uint8_t, 4>>& palette_;
  glm::vec3 light_;
  VertexStage stage_;
  Caps caps_;
  CapHatching hatching_;
  int width_, height_;
  bool vertex_colors_, smooth_normals_;
};

/// The colours of triangles that were shaded a short while ago: most show in the row above, too.
class KeptShades {
 public:
  /// Slots are the table's, which stays as it is.
  KeptShades(const SlotTable& table, const TriangleShader& shader);

  /// Of a triangle whose colours vary no colour, and any_varies() is true from then on.
  Rgba of(uint32_t slot) { return std::bit_cast<Rgba>(colors_[place_of(slot)]); }
  /// For kernels: those that do not vary.
  SlotColors known();
  bool any_varies() const { return any_varies_; }
  /// Of a triangle that varies: whether with the colours of its corners, and what normals they have.
  struct Kind {
    bool colors = false;
    ChunkNormals normals = ChunkNormals::none;
  };
  Kind kind(uint32_t slot) { return kinds_[place_of(slot)]; }
  /// Triangles with normals of the model's files, bending or not.
  uint64_t smooth_triangles() const { return smooth_triangles_; }
  void begin_row() { any_varies_ = false; }

  /// Whether the colours of the slot's triangle vary, as where caps show in its place; and what they are at a
  /// pixel's centre.
  bool varies(uint32_t slot) { return is_changing(place_of(slot)); }
  Rgba of(uint32_t slot, int32_t x, int32_t y);

 private:
  static constexpr uint32_t count = 1024, varying_count = 256;
  static constexpr uint32_t no_slot(uint32_t place) { return place + 1; }  ///< it belongs to another place
  struct Varying {
    uint32_t slot;
    InterpolatedColors colors;
  };
  /// Where it stands, now at the latest.
  uint32_t place_of(uint32_t slot);
  /// Whether its colours vary, or it is capped.
  bool is_changing(uint32_t place) const { return slots_[place] != even_slots_[place]; }

  const SlotTable& table_;
  const TriangleShader& shader_;
  std::array<uint32_t, count> slots_, colors_;
  std::array<uint32_t, count>
      even_slots_;  ///< the same slots, without those whose colours vary or that are capped
  std::bitset<count> varies_, capped_;
  size_t range_ = 0;                            ///< where the last slot was found
  std::array<Varying, varying_count> varying_;  // unused, and so not touched, in pictures without any
  std::bitset<varying_count> varying_is_set_;
  std::array<Kind, count> kinds_;  // set where its slot is
  uint64_t smooth_triangles_ = 0;
  bool any_varies_ = false;
};

/// Counts pixels of triangles that vary.
class VaryingPixels {
 public:
  void add(const KeptShades::Kind& kind) {
    ++all_;
    colored_ += kind.colors;
    smooth_ += kind.normals == ChunkNormals::of_files;
  }
  void add_to(ShadingCounts& counts) const {
    counts.varying_pixels += all_;
    counts.colored_pixels += colored_;
    counts.smooth_pixels += smooth_;
  }

 private:
  uint64_t all_ = 0, colored_ = 0, smooth_ = 0;
};

/// The colours of a row's pixels, background where nothing is. Those whose colours vary get none: recent says
/// whether there are any.
void shade_row(std::span<const uint32_t> depths, std::span<const uint32_t> slots, KeptShades& recent,
               Rgba* row);

}  // namespace triptych
