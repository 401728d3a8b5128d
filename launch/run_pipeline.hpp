// The local pipeline that a run's flags ask for.
#pragma once

#include "launch/command.hpp"
#include "nodes/local_pipeline.hpp"

namespace triptych {

/// Of the run's size. device: chosen, of the run.
inline LocalPipelineOptions pipeline_options(const RunOptions& run, const CullChoice& cull,
                                             const DeviceOptions& device) {
  return {.width = run.size.width,
          .height = run.size.height,
          .cull = cull.kind,
          .min_pixels = cull.min_pixels,
          .device = device};
}

}  // namespace triptych
