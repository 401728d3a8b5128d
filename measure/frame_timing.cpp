#include "measure/frame_timing.hpp"

namespace triptych {

void begin_other_view(FrameTarget& target, const Skeleton& skeleton, const FrameRequest& frame) {
  FrameState other = frame.state;
  other.pixel_error += 1;
  target.begin(FrameView(skeleton, other));
  target.draw({});
  target.finish();
}

}  // namespace triptych
