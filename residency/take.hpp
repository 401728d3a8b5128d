// How a device takes a chunk that it has not.
#pragma once

#include "residency/chunk_cache.hpp"
#include "residency/residency.hpp"

#include <optional>
#include <string>

namespace triptych {

/// The chunk's geometry; nullopt where the draw is to do without it: it is still to be read, or cannot be,
/// which is said once. Error for damage where MissingChunks::fail is set.
std::optional<Chunk> take(Residency& residency, uint32_t chunk, const MissingChunks& missing,
                          ChunkCache& cache);

/// A level of a texture; where it cannot be read, which is said, one that leaves colours as they are. Error
/// for damage where MissingChunks::fail is set.
std::vector<Texel> take_texels(Residency& residency, const Texture& texture, uint32_t index, uint32_t level,
                               const MissingChunks& missing);

/// Says that a chunk cannot be read. damage: an error's text.
void say_damaged(const std::string& damage);

}  // namespace triptych
