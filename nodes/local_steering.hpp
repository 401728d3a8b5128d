// The local pipeline, each frame steered to take no longer than a target.
#pragma once

#include "nodes/frame_steering.hpp"

#include <optional>

namespace triptych {

/// Calibrates before the first frame. A frame's cost includes its steering.
class LocalSteering {
 public:
  /// The pipeline must outlive it.
  LocalSteering(LocalPipeline& pipeline, const SteeringOptions& options)
      : pipeline_(pipeline), steering_(pipeline.hierarchy().skeleton(), options) {}

  /// Raises the frame's pixel error where it has to, and draws it.
  FrameRecord draw(FrameRequest& frame);

  const FrameSteering& steering() const { return steering_; }

 private:
  LocalPipeline& pipeline_;
  FrameSteering steering_;
  bool calibrated_ = false;
  /// Wall time over cost, of undisturbed frames: parts of a frame are done by one thread alone.
  double stretch_ = 1;
};

/// A pipeline's steering; none where the target is 0. device: what it draws with.
std::optional<LocalSteering> steer(LocalPipeline& pipeline, double target_ms, const DeviceNames& device);

}  // namespace triptych
