// One scene drawn every way there is: culled by both kinds of test, un-culled, and as an item buffer.
#pragma once

#include "nodes/local_pipeline.hpp"
#include "tests/support/pictures.hpp"
#include "tests/support/test_device.hpp"

#include <algorithm>
#include <vector>

namespace triptych {

using test::differing_pixels;

/// The fallback and, beside it, the un-culled picture of the same cut.
class Rig {
 public:
  Rig(const Pack& pack, int width, int height, const DeviceOptions& device = test::device(),
      CullOptions batches = {})
      : culled_(pack, {.width = width, .height = height, .batches = batches, .device = device}),
        whole_(pack, {.width = width, .height = height, .cull = StrategyKind::frustum, .device = device}) {}

  struct Frame {
    FrameRecord record;
    size_t differing_pixels = 0;
  };
  Frame draw(const FrameRequest& request) {
    Frame frame{.record = culled_.draw(request)};
    whole_.draw(request);
    frame.differing_pixels = differing_pixels(culled_.target().read_colors(), whole_.target().read_colors());
    return frame;
  }
  /// The un-culled picture of the last frame.
  const FrameTarget& whole() const { return whole_.target(); }

 private:
  LocalPipeline culled_, whole_;
};

}  // namespace triptych
