// What work a frame will be at a pixel error, before it is drawn.
#pragma once

#include "base/epoch_marks.hpp"
#include "nodes/cost_model.hpp"
#include "nodes/covered_pixels.hpp"
#include "visibility/map_to_cut.hpp"

#include <vector>

namespace triptych {

/// Maps V(i−1), or an earlier set, to the cut of the frame at that pixel error, and counts what it is mapped
/// to. That is what the occlusion representation will be drawn from; what the frame finds besides is not
/// known before. Walks what was visible and nothing else; reuses its memory. For one thread.
class WorkEstimator {
 public:
  explicit WorkEstimator(const Skeleton& skeleton);

  FrameWork estimate(const FrameView& view, const VisibleSet& previous);
  /// These were drawn: their chunks are in memory from now on.
  void loaded(const std::vector<DrawableId>& drawn);

 private:
  const Skeleton& skeleton_;
  CoveredPixels covered_;
  LazyCut cut_;
  CutMapper mapper_;
  EpochMarks loaded_, counted_;  ///< chunks
};

}  // namespace triptych
