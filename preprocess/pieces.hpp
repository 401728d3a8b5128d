// Surfaces whose box is mostly air, such as pipes that cross in a hall, in pieces whose boxes fit.
#pragma once

#include "preprocess/pack_writer.hpp"
#include "simplify/surface.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

/// The most pieces of a surface.
constexpr size_t max_pieces = 32;
static_assert(max_pieces <= max_chunk_pieces);

/// For each triangle the piece that it is in, numbered in order of appearance; empty if the surface is better
/// tested by one box. Connected components, large ones cut like partition_triangles(), are joined bottom-up,
/// each time the two that raise the area of all boxes the least, while that costs less than the test of
/// another box, or there are more than `max_pieces` (agglomerative clustering as in Walter, Bala, Kulkarni
/// and Pingali, Fast agglomerative clustering for rendering, 2008).
std::vector<uint8_t> fitting_pieces(const Surface& surface);

/// The surface as a chunk, in pieces where they fit it better if `in_pieces`. palette, runs: as in
/// encode_chunk().
EncodedChunk encode(const Surface& surface, bool in_pieces, Palette palette,
                    std::span<const uint32_t> runs = {});

}  // namespace triptych
