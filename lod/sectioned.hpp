// How much of what is drawn a section cuts open, and what of it has no cut surface.
#pragma once

#include "lod/frame_view.hpp"
#include "lod/hierarchy.hpp"
#include "scene/pack.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

/// Of placements whose boxes a side of the section may go through.
struct SectionedCounts {
  uint64_t placements = 0;
  /// Of those, the ones that are not proven solid as a whole: where they are open, their insides show instead
  /// of a cut surface.
  uint64_t open = 0;
  bool operator==(const SectionedCounts&) const = default;
};

/// Counts them frame by frame, for whoever shows a frame. Reads a chunk when it is cut for the first time.
/// For one thread.
class SectionedCounter {
 public:
  /// Both must outlive it; the hierarchy is the pack's.
  SectionedCounter(const Pack& pack, const Hierarchy& hierarchy)
      : pack_(pack), hierarchy_(hierarchy), known_(pack.skeleton().chunks.size(), Known::nothing) {}

  /// drawn: V(i). Error (pack) for a chunk that is damaged.
  SectionedCounts count(const FrameView& view, std::span<const DrawableId> drawn);

 private:
  enum class Known : uint8_t { nothing, open, solid };
  bool is_solid(uint32_t chunk);

  const Pack& pack_;
  const Hierarchy& hierarchy_;
  std::vector<Known> known_;  ///< of each chunk
};

}  // namespace triptych
