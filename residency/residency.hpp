// The seam to residency: which chunks of a pack are in memory, and which come next.
#pragma once

#include "scene/chunk.hpp"

#include <cstdint>

namespace triptych {

/// Chunks by their index. A device requests the chunks that it will need, gives the residency time to get
/// them, and pins those that it uses; a chunk that is not resident is not drawn, and counts as visible. To be
/// used by one thread; it may read on others.
class Residency {
 public:
  virtual ~Residency() = default;

  /// Requests a chunk; costs nothing if it is resident already. Higher priorities are read first, equal ones
  /// in the order of their requests.
  virtual void request(uint32_t chunk, float priority) = 0;
  /// Reads what was requested, for about budget_ms milliseconds; with an infinite budget until all is read.
  /// Returns how many requests are still open. Error (pack, chunk) for damage: that request is dropped.
  virtual size_t pump(double budget_ms) = 0;

  /// The chunk's geometry, which stays until unpin(); null if it is not resident. Pins are counted.
  virtual const Chunk* pin(uint32_t chunk) = 0;
  virtual void unpin(uint32_t chunk) = 0;

  /// Drops a chunk that is not pinned; a device calls this once it has its own copy. Does nothing if it is
  /// not resident.
  virtual void evict(uint32_t chunk) = 0;

  /// Bytes that chunks take here.
  virtual uint64_t memory_bytes() const = 0;
};

}  // namespace triptych
