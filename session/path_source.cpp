#include "session/path_source.hpp"

#include "base/error.hpp"
#include "session/run_options.hpp"

#include <utility>

namespace triptych {

PathSource::PathSource(std::vector<FrameRequest> once, uint32_t first, size_t loop) : once_(std::move(once)) {
  if (loop > max_frames / once_.size()) fail("--loop", "{} times {} frames are too many", loop, once_.size());
  numbers_ = {first, static_cast<uint32_t>(once_.size() * loop)};
}

FrameRequest PathSource::next(uint32_t number) {
  FrameRequest frame = once_[number % once_.size()];
  frame.number = number;
  return frame;
}

}  // namespace triptych
