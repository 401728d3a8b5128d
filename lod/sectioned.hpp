// How much of what is drawn a section cuts open, and what of it has no cut surface.
#pragma once

#include "lod/frame_view.hpp"
#include "lod/hierarchy.hpp"

#include <cstdint>
#include <span>

namespace triptych {

/// Of placements whose boxes a side of the section may go through.
struct SectionedCounts {
  uint64_t placements = 0;
  /// Of those, the ones that are not closed as a whole: where they are open, their insides show instead of a
  /// cut surface.
  uint64_t open = 0;
  bool operator==(const SectionedCounts&) const = default;
};

/// drawn: V(i).
SectionedCounts count_sectioned(const Hierarchy& hierarchy, const FrameView& view,
                                std::span<const DrawableId> drawn);

}  // namespace triptych
