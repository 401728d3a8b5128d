// A session's frames from a recorded path.
#pragma once

#include "nodes/frame_source.hpp"

#include <vector>

namespace triptych {

/// The path's frames, over and over.
class PathSource : public FrameSource {
 public:
  /// first: the number of the first frame; earlier ones are left out. loop: how often the path is played.
  /// Error where there are more frames than frame numbers.
  PathSource(std::vector<FrameRequest> once, uint32_t first, size_t loop);

  Numbers numbers() const override { return numbers_; }
  FrameRequest next(uint32_t number) override;

 private:
  std::vector<FrameRequest> once_;
  Numbers numbers_;
};

}  // namespace triptych
