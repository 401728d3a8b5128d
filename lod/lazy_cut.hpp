// The cut of one frame, selected where somebody looks and nowhere else.
#pragma once

#include "base/epoch_marks.hpp"
#include "lod/cut.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace triptych {

/// Agrees with select_cut() wherever it is asked. What nobody asks for (what lies under a hidden scene node)
/// costs nothing. Room for all scene nodes is made once; a frame touches what it looks at. For one thread.
class LazyCut {
 public:
  explicit LazyCut(const Skeleton& skeleton);

  /// A new frame: forgets what was selected.
  void begin(const FrameView& view);
  /// The same where the whole cut was selected before: every scene node has its choice.
  void begin(const FrameView& view, const Cut& cut);
  const FrameView& view() const { return *view_; }

  /// As Cut::choice, for any scene node: chooses at those of its ancestors, from the root down, that decide
  /// it.
  DrawableId choice(SceneNodeId node);

  /// How many drawables were chosen since begin().
  uint64_t selected() const { return selected_; }

 private:
  const Skeleton& skeleton_;
  std::optional<FrameView> view_;
  EpochMarks known_;
  std::vector<DrawableId> choices_;  ///< of known scene nodes
  uint64_t selected_ = 0;
};

}  // namespace triptych
