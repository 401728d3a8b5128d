#include "nodes/local_steering.hpp"

#include <algorithm>

namespace triptych {

FrameRecord LocalSteering::draw(FrameRequest& frame) {
  if (!calibrated_) steering_.calibrate(pipeline_, frame);
  calibrated_ = true;
  const SpentTime before = spent_time();
  steering_.steer(frame, std::max(1.0, stretch_));
  FrameRecord record = pipeline_.draw(frame);
  const SpentTime after = spent_time(), spent = after - before;
  record.steered = steering_.drawn(frame.number, record.visible, cost_of(spent, steering_.options().measure));
  record.steered.wall_ms = spent.wall_ms;
  record.steered.undisturbed = is_undisturbed(before, after);
  if (record.steered.undisturbed && record.steered.cost_ms > 0) {
    constexpr double following = 0.1, most = 16;
    stretch_ += following * (std::min(most, spent.wall_ms / record.steered.cost_ms) - stretch_);
  }
  return record;
}

std::optional<LocalSteering> steer(LocalPipeline& pipeline, double target_ms, const DeviceNames& device) {
  if (target_ms <= 0) return std::nullopt;
  return LocalSteering(pipeline,
                       {.target_ms = target_ms, .measure = measure_of(device), .rules = pipeline.rules()});
}

}  // namespace triptych
