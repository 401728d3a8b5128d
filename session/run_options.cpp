#include "session/run_options.hpp"

#include "base/error.hpp"
#include "lod/clip_space.hpp"
#include "scene/path.hpp"

#include <algorithm>
#include <fmt/core.h>

namespace triptych {

namespace {

/// Its camera at this size, and that its frustum is wide enough for the single precision of devices.
void check_view(const View& view, const Skeleton& skeleton, const std::string& place) {
  const Camera& camera = view.camera;
  check_camera(camera, place);
  constexpr double least = 1e-20;  // times the farthest coordinate of a vertex, and squared: below 2^127
  const double unit = camera.orthographic() ? clip_space(skeleton, view, view.rotation()).unit : 1;
  if (std::min(camera.right - camera.left, camera.top - camera.bottom) < least * unit)
    fail(place, "the camera's frustum is too narrow to be computed: less than {} of {}", least,
         camera.orthographic() ? "the model's size" : "the distance");
}

}  // namespace

std::vector<FrameRequest> load_frames(const RunOptions& options, const Skeleton& skeleton) {
  const Path path = load_path(options.path);
  const size_t count = options.frames > 0 ? std::min(options.frames, path.frames.size()) : path.frames.size();
  std::vector<FrameRequest> frames;
  const double near = skeleton.default_near();
  for (size_t i = 0; i < count; i += options.every) {
    const View view = path.view(i, options.size.width, options.size.height, near);
    check_view(view, skeleton, fmt::format("{} frame {}", options.path.string(), i));
    frames.push_back({static_cast<uint32_t>(i),
                      {view, options.pixel_error(), options.samples, options.edges, options.section}});
  }
  return frames;
}

}  // namespace triptych
