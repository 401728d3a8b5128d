// Which triangles show what lies behind them: those whose base colour has an alpha below 1, and those whose
// texture has holes.
#pragma once

#include "scene/chunk.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

/// Colours of a palette, and what else they have.
struct Palette {
  Palette() = default;
  Palette(std::span<const std::array<uint8_t, 4>> of_colors, std::span<const SurfaceMaterial> of_materials)
      : colors(of_colors), materials(of_materials) {}
  Palette(const std::vector<std::array<uint8_t, 4>>& of_colors) : colors(of_colors) {}
  Palette(const Skeleton& skeleton) : Palette(skeleton.palette, skeleton.materials) {}

  std::span<const std::array<uint8_t, 4>> colors;
  std::span<const SurfaceMaterial> materials;  ///< of each of them, or empty

  bool empty() const { return colors.empty(); }
  const std::array<uint8_t, 4>& operator[](size_t index) const { return colors[index]; }
};

/// Of a colour of the palette: it covers what lies behind by alpha / 255.
inline bool is_transparent(const std::array<uint8_t, 4>& color) { return color[3] < 255; }
/// Whether surfaces of that colour have holes where their texture says so.
inline bool is_cut_out(Palette palette, size_t index) {
  return !palette.materials.empty() && palette.materials[index].cutoff > 0;
}
/// Whether backs are seen through surfaces of that colour: it is transparent, or cut out.
inline bool is_seen_through(Palette palette, size_t index) {
  return is_transparent(palette[index]) || is_cut_out(palette, index);
}
/// Which of them are transparent, and then, behind a number that no colour has, which are cut out, by index.
std::vector<uint32_t> seen_through_colors(Palette palette);
/// Of a triangle: that of its last corner.
inline uint32_t palette_index(const Chunk& chunk, size_t triangle) {
  return chunk.vertices[chunk.indices[3 * triangle + 2]].color;
}

/// Where runs of triangles end: of opaque ones, of transparent ones, and so on in turn, up to the last
/// triangle; empty if none is transparent.
std::vector<uint32_t> transparent_runs(const Chunk& chunk, Palette palette);
/// The same of solid ones, and of those that are cut out and not transparent.
std::vector<uint32_t> cut_out_runs(const Chunk& chunk, Palette palette);

/// Calls of_run(first, last, transparent) for each stretch of triangles first up to, not including, last in
/// [begin, end). runs: as transparent_runs() or cut_out_runs() gives them.
template <typename OfRun>
void for_each_run(std::span<const uint32_t> runs, uint32_t begin, uint32_t end, const OfRun& of_run) {
  bool transparent = false;
  uint32_t first = begin;
  for (const uint32_t run_end : runs) {
    const uint32_t last = run_end < end ? run_end : end;
    if (last > first) of_run(first, last, transparent);
    first = last > first ? last : first;
    transparent = !transparent;
  }
  if (end > first) of_run(first, end, false);
}

}  // namespace triptych
