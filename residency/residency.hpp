// The seam to residency: how a device gets the chunks of a pack.
#pragma once

#include "scene/chunk.hpp"

#include <cstdint>
#include <optional>

namespace triptych {

/// Of a chunk that a picture lacks; coarser levels that would stand in for it have more.
inline constexpr float urgent = 4;

/// Chunks by their index. A device says which chunks it may need soon, and takes those that it draws; what it
/// has taken is its own, and is to be taken again once it was dropped (residency/chunk_cache.hpp). To be used
/// by one thread; it may read on others.
class Residency {
 public:
  virtual ~Residency() = default;

  /// The chunk may be needed soon: it may be read ahead. Higher priorities first.
  virtual void expect(uint32_t chunk, float priority) = 0;
  /// The chunk's geometry; read now, if it was not read ahead. Error (pack, chunk) for damage.
  virtual Chunk take(uint32_t chunk) = 0;
  /// The same without waiting: nullopt, and it is expected urgently, where it was not read ahead.
  virtual std::optional<Chunk> take_if_ready(uint32_t chunk) = 0;
  /// A level of a texture, read now. Any thread may ask. Error (pack, texture) for damage.
  virtual std::vector<Texel> read_texels(uint32_t texture, uint32_t level) = 0;
};

}  // namespace triptych
