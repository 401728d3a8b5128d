// The visible set of one frame as drawables of the next frame's cut: what the occlusion representation is
// drawn from.
#pragma once

#include "base/epoch_marks.hpp"
#include "lod/lazy_cut.hpp"
#include "visibility/visible_set.hpp"

#include <vector>

namespace triptych {

/// Reuses its memory from frame to frame. For one thread.
class CutMapper {
 public:
  explicit CutMapper(const Skeleton& skeleton);

  /// For each drawable its scene node's drawable in the cut (kept, perhaps at another level of detail), or
  /// its ancestor's there, or all its descendants' there; what left the frustum, or is hidden now, maps to
  /// nothing. In draw rank order under the cut's view, each once. Valid until the next call.
  const std::vector<DrawableId>& map(LazyCut& cut, const VisibleSet& visible);

 private:
  void add(DrawableId id);
  void add_below(LazyCut& cut, SceneNodeId node);

  const Skeleton& skeleton_;
  EpochMarks added_;  ///< drawables
  std::vector<DrawableId> mapped_;
  std::vector<SceneNodeId> open_;
  RankSorter sorter_;
};

}  // namespace triptych
