// The seam to a strategy: how the drawables of a cut that will be drawn are chosen, and what it promises.
#pragma once

#include "lod/cut.hpp"
#include "visibility/cull_result.hpp"
#include "visibility/cull_sink.hpp"
#include "visibility/frame_target.hpp"

#include <span>
#include <string>

namespace triptych {

/// An occlusion representation R(i), which OR draws before the strategy runs; where a strategy has none, OR
/// is idle.
class OcclusionRepresentation {
 public:
  virtual ~OcclusionRepresentation() = default;
  /// Frame i: empties R(i), which the target keeps until the next begin().
  virtual void begin(const FrameView& view, FrameTarget& target) = 0;
  /// Draws those drawables of V(i−1) that are decided, mapped to cut i. May be called as packets arrive.
  virtual void add(const VisibleSet& visible, FrameTarget& target) = 0;
  /// The drawables of cut i that were drawn, in this order.
  virtual std::span<const DrawableId> drawables() const = 0;
};

/// Chooses levels of detail by itself, lazily or by select_cut(), draws and tests on the target where it
/// needs to, and gives drawables in draw rank order from packet to packet. The same frame, previous set and
/// answers of the target give the same set, whatever the timing. Reuses its memory from frame to frame. For
/// one thread.
///
/// A strategy is an ExactStrategy or an ApproximateStrategy: code that claims exactness accepts only the
/// former.
class Strategy {
 public:
  virtual ~Strategy() = default;

  /// As --cull names it.
  virtual const std::string& name() const = 0;
  /// The cut whose un-culled picture its guarantee refers to.
  virtual FrustumCulling reference() const { return FrustumCulling::on; }
  /// Null where it needs none. Otherwise begin() and add() come before each run(), under the same view and on
  /// the same target.
  virtual OcclusionRepresentation* representation() { return nullptr; }

  /// view: of frame i; previous: V(i−1). target: its depth holds R(i) where there is a representation.
  /// sink: called at least once, with V(i−1) → V(i) in pieces; the last watermark is everything_decided.
  /// The result is valid until the next run.
  virtual const CullResult& run(const FrameView& view, const VisibleSet& previous, FrameTarget& target,
                                CullSink& sink) = 0;

 private:
  friend class ExactStrategy;
  friend class ApproximateStrategy;
  Strategy() = default;  // for the two below
};

/// Its picture equals, pixel for pixel, the picture of the whole reference cut on the same device.
class ExactStrategy : public Strategy {};

/// It may leave out drawables that are visible.
class ApproximateStrategy : public Strategy {
 public:
  /// What it may leave out, and how much of it: one sentence for people and reports.
  virtual std::string may_miss() const = 0;
};

}  // namespace triptych
