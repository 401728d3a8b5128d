// Steers the pixel error of frames so that each takes no longer than a target.
#pragma once

#include "base/spent_time.hpp"
#include "nodes/frame_governor.hpp"
#include "nodes/local_pipeline.hpp"
#include "nodes/work_estimator.hpp"

#include <deque>
#include <optional>
#include <utility>
#include <vector>

namespace triptych {

/// What a frame costs, in milliseconds.
enum class CostMeasure {
  /// Processor time of the process over the threads that it works with: what the frame takes where all of it
  /// is spread evenly. Other processes disturb it least.
  cpu_over_threads,
  wall,  ///< where a graphics card draws, or other processes take part
};
/// As reports name it.
const std::string& measure_name(CostMeasure measure);
/// Processor time, unless a graphics card draws.
CostMeasure measure_of(const DeviceNames& device);
double cost_of(const SpentTime& spent, CostMeasure measure);

struct SteeringOptions {
  double target_ms = 0;  ///< above 0
  CostMeasure measure = CostMeasure::cpu_over_threads;
  FrameRules rules = {};
};

/// Sits where cameras are released: a frame's pixel error is chosen before its view is made, and belongs to
/// the frame state from then on. What it will cost is predicted from the work that the last visible set
/// that was drawn means at that pixel error.
class FrameSteering {
 public:
  /// The skeleton must outlive it.
  FrameSteering(const Skeleton& skeleton, const SteeringOptions& options);

  /// Draws the first frame at pixel errors from the largest to the asked one, by factors of 2, each twice:
  /// the first one reads chunks. Ends early after two seconds, or once a frame costs more than twice the
  /// target. The pipeline, whose target is of the frame's size, has chunks in memory afterwards, and else
  /// begins anew.
  void calibrate(LocalPipeline& pipeline, const FrameRequest& first);

  /// Raises the frame's pixel error where it would take too long. stretch: by how much longer frames take
  /// than they cost, at least 1.
  void steer(FrameRequest& frame, double stretch = 1);
  /// A frame that was steered showed this set, V(i), and cost so much; earlier ones that were not reported
  /// are forgotten. The next steer() learns from it, which is part of that frame's cost. The caller adds wall
  /// time and disturbance.
  SteeredFrame drawn(uint32_t number, const VisibleSet& visible, double cost_ms);

  /// What was estimated of the frame of the last drawn(), which must have been steered.
  const FrameWork& work_of_drawn() const { return unlearnt_->work; }

  const CostModel& model() const { return model_; }
  const SteeringOptions& options() const { return options_; }

 private:
  struct Steered {
    uint32_t number;
    FrameState state;
    FrameWork work;  ///< as it was estimated
    SteeredFrame frame;
    double stretch = 1;
  };
  void learn(const Steered& drawn);

  const Skeleton& skeleton_;
  SteeringOptions options_;
  WorkEstimator estimator_;
  CostModel model_;
  FrameGovernor governor_;
  std::vector<std::pair<double, FrameWork>> tried_;  ///< of the frame that is steered: by pixel error
  VisibleSet known_;                                 ///< the last visible set that was drawn
  std::deque<Steered> steered_;                      ///< not drawn yet
  std::optional<Steered> unlearnt_;                  ///< drawn
};

}  // namespace triptych
