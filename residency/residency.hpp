// The seam to residency: which chunks of a pack are in memory, and which come next.
#pragma once

#include "scene/chunk.hpp"

#include <cstdint>

namespace triptych {

/// Chunks by their index. Whoever draws asks for what it will need, gives residency time to get it, and pins
/// what it is using; a chunk that is not there is not drawn, and counts as visible. For one thread; what it
/// reads with is its own business.
class Residency {
 public:
  virtual ~Residency() = default;

  /// Wants a chunk: one that is there already costs nothing. Of those that are not, higher priorities come
  /// first, equal ones in the order of their requests.
  virtual void request(uint32_t chunk, float priority) = 0;
  /// Gets what was requested, for about so many milliseconds; for as long as it takes where the budget is
  /// infinite. Returns how many requests are still open. Error (pack, chunk) for damage: that request is
  /// dropped.
  virtual size_t pump(double budget_ms) = 0;

  /// The chunk's geometry, which stays until unpin(); null where it is not there. Pins count.
  virtual const Chunk* pin(uint32_t chunk) = 0;
  virtual void unpin(uint32_t chunk) = 0;

  /// Lets go of a chunk that is not pinned: whoever has it in its own memory says so. Nothing where it is not
  /// there.
  virtual void evict(uint32_t chunk) = 0;

  /// Bytes that chunks take here.
  virtual uint64_t memory_bytes() const = 0;
};

}  // namespace triptych
