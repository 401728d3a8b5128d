#include "scene/transparency.hpp"

#include <algorithm>

namespace triptych {

bool has_transparent(Palette palette) {
  return std::ranges::any_of(palette,
                             [](const std::array<uint8_t, 4>& color) { return is_transparent(color); });
}

std::vector<uint32_t> transparent_colors(Palette palette) {
  std::vector<uint32_t> found;
  for (uint32_t i = 0; i < palette.size(); ++i) {
    if (is_transparent(palette[i])) found.push_back(i);
  }
  return found;
}

bool is_transparent(const Chunk& chunk, size_t triangle, Palette palette) {
  return is_transparent(palette[chunk.vertices[chunk.indices[3 * triangle + 2]].color]);
}

std::vector<uint32_t> transparent_runs(const Chunk& chunk, Palette palette) {
  std::vector<uint32_t> ends;
  if (!std::ranges::any_of(chunk.vertices,
                           [&](const ChunkVertex& vertex) { return is_transparent(palette[vertex.color]); }))
    return ends;
  bool current = false;
  const auto count = static_cast<uint32_t>(chunk.triangle_count());
  for (uint32_t i = 0; i < count; ++i) {
    if (is_transparent(chunk, i, palette) == current) continue;
    ends.push_back(i);
    current = !current;
  }
  if (ends.empty()) return ends;  // its vertices lead to no triangle
  ends.push_back(count);
  return ends;
}

}  // namespace triptych
