// The hardware cull (HC): which drawables of a cut show past the occlusion representation.
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

/// Hears of each box that was tested, by its scene node, and whether it shows: for explanations.
class TestObserver {
 public:
  virtual ~TestObserver() = default;
  virtual void tested(SceneNodeId node, bool shows) = 0;
};

struct CullOptions {
  /// Boxes a batch, at most. Where much is found that the occlusion representation lacks, what is found in
  /// front must hide what lies behind it: at most `max_found` of a batch show at once, the nearest, the
  /// others are tested again once those are drawn, and the next batch holds `min_batch`. Each batch that
  /// finds no more than that doubles the next one. A frame begins with the least where the representation
  /// holds less than half as many drawables as were visible one frame ago, or none.
  size_t batch = 512, min_batch = 8, max_found = 2;
  /// A packet is emitted once it holds so many ids that change, and at the end. Smaller packets let receivers
  /// begin earlier and cost more bytes; docs/protocol.md has figures.
  size_t packet_ids = 32;
  /// Hears of every test; null: nobody does.
  TestObserver* observer = nullptr;
};

/// Tests the cut's drawables in draw rank order, in batches, inner scene nodes first, so that a hidden
/// subtree costs one test, and is not selected; scene nodes with content that was visible one frame ago are
/// not worth their own test. A drawable in pieces is tested by its placements' boxes, and again, by its
/// pieces', if it shows; at once by its pieces' if it was visible one frame ago. Of many pieces the two that
/// are largest on the screen are tested first, and all of them if neither shows. What is found visible and is
/// not yet in the representation is drawn into it between batches, a few at a time. Batches are cut by rank
/// and count alone, so the same frame gives the same answer whatever the timing (interactive-display-2003
/// §4.3).
///
/// Keeps its room from frame to frame: after some frames it allocates nothing. For one thread.
class HardwareCull {
 public:
  HardwareCull(const Hierarchy& hierarchy, const CullOptions& options);

  /// cut: begun under this view; what it selects besides is what the culling looks at. tester: holds R(i), in
  /// which `represented` (drawables of the cut) was drawn under the view. previous: V(i−1). sink: called at
  /// least once, with V(i−1) → V(i) in pieces. The result is good until the next run.
  const CullResult& run(const FrameView& view, LazyCut& cut, OcclusionTester& tester,
                        std::span<const DrawableId> represented, const VisibleSet& previous, CullSink& sink);

 private:
  /// What a drawable is tested by: ever more boxes, ever closer ones.
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
  void test_batch(OcclusionTester& tester);
  void judge(QueueEntry tested, bool passed, bool& too_many);
  void decide();
  void emit(CullSink& sink);

  const Hierarchy& hierarchy_;
  const Skeleton& skeleton_;
  CullOptions options_;
  EpochMarks expected_;                           ///< scene nodes above what was visible
  EpochMarks represented_, shown_, was_visible_;  ///< drawables
  std::vector<DrawRank> previous_;                ///< V(i−1) in rank order
  std::vector<QueueEntry> queue_;                 ///< a heap, the nearest on top
  std::vector<QueueEntry> tested_;
  std::vector<ScreenRectangle> rectangles_;
  std::vector<uint32_t> ends_;  ///< for each of tested_ the end of its rectangles
  std::vector<uint8_t> answers_;
  std::vector<DrawableId> found_;
  CullPacket packet_;  ///< what was decided since the last one was sent
  CullResult result_;

  // Of the frame at hand.
  const FrameView* view_ = nullptr;
  LazyCut* cut_ = nullptr;
  const BoxProjector* projector_ = nullptr;
  size_t batch_ = 0, next_previous_ = 0, found_visible_ = 0;
};

}  // namespace triptych
