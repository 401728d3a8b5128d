// What a process that draws may take.
#pragma once

#include "residency/read_ahead.hpp"
#include "scene/geometry_use.hpp"

#include <cstdint>

namespace triptych {

/// What a frame does about chunks that are still to be read.
enum class OnMiss : uint8_t {
  exact,   ///< it waits for them
  coarser  ///< it draws the nearest coarser level that is there, and counts what it owes
};

struct MemoryCaps {
  uint64_t memory = no_cap;         ///< of the process, as the kernel counts what is resident
  uint64_t device_memory = no_cap;  ///< of geometry on the device
  OnMiss on_miss = OnMiss::exact;
  bool capped() const { return memory != no_cap || device_memory != no_cap; }
  /// Whether chunks come and go while frames are drawn.
  bool streams() const { return capped() || on_miss == OnMiss::coarser; }
  bool operator==(const MemoryCaps&) const = default;
};

/// What the geometry of a process that draws took.
struct DrawingMemory {
  GeometryUse geometry{};
  ReadAheadUse read_ahead{};  ///< zeros where nothing is read ahead
};

}  // namespace triptych
