// Chunks as the bytes of a pack; scene/chunk.hpp reads them back.
#pragma once

#include "scene/transparency.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

/// Finds out which triangles are outward, reorders for the vertex cache and compresses with meshoptimizer's
/// codecs (Arseny Kapoulkine). Degenerate triangles stay. The chunk must hold at least one triangle, indices
/// in range.
///
/// runs: where runs of triangles end, ascending, that stay where they are; triangles change their places
/// within each, and behind the last. palette: in each of them triangles that are cut out follow the solid
/// ones, and transparent ones those; empty if backs are seen through none.
std::vector<std::byte> encode_chunk(const Chunk& chunk, std::span<const uint32_t> runs = {},
                                    Palette palette = {});

}  // namespace triptych
