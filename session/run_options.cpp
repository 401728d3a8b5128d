#include "session/run_options.hpp"

#include "scene/path.hpp"

#include <algorithm>

namespace triptych {

std::vector<FrameRequest> load_frames(const RunOptions& options, const Skeleton& skeleton) {
  const Path path = load_path(options.path);
  const size_t count = options.frames > 0 ? std::min(options.frames, path.frames.size()) : path.frames.size();
  std::vector<FrameRequest> frames;
  for (size_t i = 0; i < count; ++i) {
    frames.push_back({static_cast<uint32_t>(i),
                      {path.view(i, options.size.width, options.size.height, skeleton.default_near()),
                       options.pixel_error()}});
  }
  return frames;
}

}  // namespace triptych
