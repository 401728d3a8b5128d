// The hardware cull (HC): which drawables of a cut the occlusion representation does not hide.
#pragma once

#include "base/epoch_marks.hpp"
#include "lod/hierarchy.hpp"
#include "lod/lazy_cut.hpp"
#include "visibility/cull_result.hpp"
#include "visibility/cull_sink.hpp"
#include "visibility/occlusion_tester.hpp"
#include "visibility/screen_bounds.hpp"

#include <span>
#include <vector>

namespace triptych {

/// Is told of each box that was tested, by its scene node, and whether it shows: for explanations.
class TestObserver {
 public:
  virtual ~TestObserver() = default;
  virtual void tested(SceneNodeId node, bool shows) = 0;
};

struct CullOptions {
  /// Boxes in a batch, at most. Where much is found that the occlusion representation lacks, what is found
  /// in front must hide what lies behind it: only the nearest `max_found` of a batch are accepted at once,
  /// the others are tested again after those have been drawn, and the next batch holds `min_batch` boxes.
  /// Each batch that finds no more than `max_found` doubles the size of the next one. A frame begins with
  /// `min_batch` where the representation is empty or holds less than half as many drawables as were
  /// visible one frame ago.
  size_t batch = 512, min_batch = 8, max_found = 2;
  /// A packet is emitted once it holds this many added and removed ids, and at the end of the frame. Smaller
  /// packets let receivers begin earlier and cost more bytes; docs/protocol.md has figures.
  size_t packet_ids = 32;
  /// Is told of every test; may be null.
  TestObserver* observer = nullptr;
};

/// Tests the cut's drawables in draw rank order, in batches, inner scene nodes first, so that a hidden
/// subtree costs one test, and no levels are selected in it; inner scene nodes above what was visible one
/// frame ago are not tested themselves. A drawable in pieces is tested by its placements' boxes, and if one
/// of those shows, again by its pieces' boxes; if it was visible one frame ago, by its pieces' boxes at
/// once. Of many pieces the two that are largest on the screen are tested first, and all of them if neither
/// shows. What is found visible and is not yet in the representation is drawn into it between batches, a
/// few at a time. Batches are cut by rank and count alone, so the same frame gives the same answer whatever
/// the timing (interactive-display-2003 §4.3).
///
/// Reuses its memory from frame to frame: after some frames it allocates nothing. For one thread.
class HardwareCull {
 public:
  /// min_pixels: what shows at fewer pixels counts as hidden; with 1 nothing that is visible does.
  HardwareCull(const Hierarchy& hierarchy, const CullOptions& options, uint32_t min_pixels = 1);

  /// cut: begun under this view; the culling selects from it what it looks at. tester: holds R(i), into
  /// which `represented` (drawables of the cut) was drawn under the view. previous: V(i−1). sink: called at
  /// least once, with V(i−1) → V(i) in pieces. The result is valid until the next run.
  const CullResult& run(const FrameView& view, LazyCut& cut, OcclusionTester& tester,
                        std::span<const DrawableId> represented, const VisibleSet& previous, CullSink& sink);

 private:
  /// Which boxes a drawable is tested by: from few loose ones to many tight ones.
  enum class Boxes : uint8_t { placements, largest_pieces, all };

  /// A scene node that waits for its test. Ordered by distance, then by id.
  struct QueueEntry {
    uint64_t distance;
    SceneNodeId node;
    Boxes boxes = Boxes::placements;
    auto operator<=>(const QueueEntry&) const = default;
  };

  void begin(std::span<const DrawableId> represented, const VisibleSet& previous);
  void push(SceneNodeId node);
  void push_children(SceneNodeId id);
  void enqueue(const QueueEntry& entry);
  QueueEntry dequeue();
  void show(SceneNodeId node);
  bool may_show(SceneNodeId node) const;
  void fill_batch();
  ScreenBounds::Kind append_bounds(QueueEntry& entry, bool inner);
  ScreenBounds::Kind append_bounds_of(QueueEntry& entry);
  void test_batch();
  void judge(QueueEntry tested, bool passed, bool& too_many);
  void decide();
  void emit(CullSink& sink);

  const Hierarchy& hierarchy_;
  const Skeleton& skeleton_;
  CullOptions options_;
  uint32_t min_pixels_;
  EpochMarks expected_;                           ///< scene nodes above what was visible one frame ago
  EpochMarks represented_, shown_, was_visible_;  ///< drawables
  std::vector<DrawRank> previous_;                ///< V(i−1) in rank order
  std::vector<QueueEntry> queue_;                 ///< a heap, the nearest on top
  std::vector<QueueEntry> tested_;
  std::vector<ScreenRectangle> rectangles_;
  std::vector<uint32_t> ends_;  ///< for each entry of tested_ the end of its rectangles
  std::vector<uint8_t> answers_;
  std::vector<DrawableId> found_;
  CullPacket packet_;  ///< what was decided since the last one was sent
  CullResult result_;

  // Of the current frame.
  const FrameView* view_ = nullptr;
  LazyCut* cut_ = nullptr;
  const BoxProjector* projector_ = nullptr;
  OcclusionTester* tester_ = nullptr;
  size_t batch_ = 0, next_previous_ = 0, found_visible_ = 0;
};

}  // namespace triptych
