#include "measure/frame_timing.hpp"

#include <ctime>

namespace triptych {

double process_cpu_milliseconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) * 1e-6;
}

void begin_other_view(FrameTarget& target, const Skeleton& skeleton, const FrameRequest& frame) {
  FrameState other = frame.state;
  other.pixel_error += 1;
  target.begin(FrameView(skeleton, other));
  target.draw({});
  target.finish();
}

}  // namespace triptych
