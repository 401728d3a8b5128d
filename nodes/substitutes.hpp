// What is drawn in place of drawables whose chunks are not on the device.
#pragma once

#include "lod/frame_view.hpp"
#include "lod/hierarchy.hpp"
#include "residency/read_ahead.hpp"
#include "visibility/device.hpp"

#include <cstddef>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace triptych {

class Substitutes {
 public:
  /// All must outlive it.
  Substitutes(const Hierarchy& hierarchy, const Device& device, ReadAhead& residency)
      : hierarchy_(hierarchy), skeleton_(hierarchy.skeleton()), device_(device), residency_(residency) {}

  /// Replaces drawables (ascending) that are not there, on the device or read ahead, by the nearest coarser
  /// one that is and may stand for its scene node, and with it all others below that node. Where none is
  /// there the coarsest that may takes its place, and where none may it stays: those are to be waited for.
  /// Expects what lies between, the coarsest first, so that a picture gets finer level by level. Returns how
  /// many drawables were not there.
  size_t replace(const FrameView& view, VisibleSet& drawables);

 private:
  bool is_there(DrawableId id) const;
  bool is_damaged(DrawableId id) const;
  DrawableId nearest(const FrameView& view, DrawableId id);
  DrawableId topmost(DrawableId id) const;

  const Hierarchy& hierarchy_;
  const Skeleton& skeleton_;
  const Device& device_;
  ReadAhead& residency_;
  std::unordered_set<uint32_t> ready_;
  std::unordered_set<uint32_t> unreadable_;  ///< chunks that will never be there
  std::unordered_map<SceneNodeId, DrawableId> chosen_;
  std::vector<DrawableId> between_;  ///< what is shown and what is missing, the finest first
};

}  // namespace triptych
