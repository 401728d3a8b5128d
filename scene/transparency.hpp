// Which triangles let light through: those whose base colour has an alpha below 1.
#pragma once

#include "scene/chunk.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

using Palette = std::span<const std::array<uint8_t, 4>>;

/// Of a colour of the palette: it covers what lies behind by alpha / 255.
inline bool is_transparent(const std::array<uint8_t, 4>& color) { return color[3] < 255; }
/// Whether any of the colours is.
bool has_transparent(Palette palette);
/// Which of them are, by index.
std::vector<uint32_t> transparent_colors(Palette palette);
/// Which of its triangles are: by the colour of their last corners.
bool is_transparent(const Chunk& chunk, size_t triangle, Palette palette);

/// Where runs of triangles end: of opaque ones, of transparent ones, and so on in turn, up to the last
/// triangle; empty if none is transparent.
std::vector<uint32_t> transparent_runs(const Chunk& chunk, Palette palette);

/// Calls of_run(first, last, transparent) for each stretch of triangles first up to, not including, last in
/// [begin, end). runs: as transparent_runs() gives them.
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
