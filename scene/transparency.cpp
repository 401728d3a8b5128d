#include "scene/transparency.hpp"

#include <algorithm>

namespace triptych {

namespace {

/// Where runs of triangles end, those without first, and those with a colour of which `has` holds.
template <typename Has>
std::vector<uint32_t> runs_of(const Chunk& chunk, const Has& has) {
  std::vector<uint32_t> ends;
  if (!std::ranges::any_of(chunk.vertices, [&](const ChunkVertex& vertex) { return has(vertex.color); }))
    return ends;
  bool current = false;
  const auto count = static_cast<uint32_t>(chunk.triangle_count());
  for (uint32_t i = 0; i < count; ++i) {
    if (has(palette_index(chunk, i)) == current) continue;
    ends.push_back(i);
    current = !current;
  }
  if (ends.empty()) return ends;  // its vertices lead to no triangle
  ends.push_back(count);
  return ends;
}

}  // namespace

std::vector<uint32_t> seen_through_colors(Palette palette) {
  constexpr uint32_t no_color = 0xffffffffu;
  std::vector<uint32_t> found;
  for (uint32_t i = 0; i < palette.colors.size(); ++i) {
    if (is_transparent(palette[i])) found.push_back(i);
  }
  if (palette.materials.empty()) return found;
  found.push_back(no_color);
  for (uint32_t i = 0; i < palette.colors.size(); ++i) {
    if (is_cut_out(palette, i)) found.push_back(i);
  }
  return found;
}

std::vector<uint32_t> transparent_runs(const Chunk& chunk, Palette palette) {
  return runs_of(chunk, [&](uint32_t color) { return is_transparent(palette[color]); });
}

std::vector<uint32_t> cut_out_runs(const Chunk& chunk, Palette palette) {
  if (palette.materials.empty()) return {};
  return runs_of(
      chunk, [&](uint32_t color) { return is_cut_out(palette, color) && !is_transparent(palette[color]); });
}

}  // namespace triptych
