// The cut of one frame, selected only where it is asked for.
#pragma once

#include "base/epoch_marks.hpp"
#include "lod/cut.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace triptych {

/// Agrees with select_cut() wherever it is asked. What is never asked for (what lies under a hidden scene
/// node) costs nothing. Memory for all scene nodes is allocated once; a frame touches only what it asks
/// for. For one thread.
class LazyCut {
 public:
  explicit LazyCut(const Skeleton& skeleton);

  /// A new frame: forgets what was selected.
  void begin(const FrameView& view);
  /// The same where the whole cut was selected beforehand: every scene node has its choice.
  void begin(const FrameView& view, const Cut& cut);
  const FrameView& view() const { return *view_; }

  /// As Cut::choice, for any scene node: chooses first, from the root down, at those of its ancestors that
  /// have no choice yet.
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
