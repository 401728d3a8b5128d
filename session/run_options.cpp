#include "session/run_options.hpp"

#include "base/error.hpp"
#include "base/notice.hpp"
#include "lod/clip_space.hpp"
#include "scene/hidden_objects.hpp"
#include "scene/object_words.hpp"
#include "scene/path.hpp"
#include "scene/sun.hpp"

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

void say_effects_left_out(const RunOptions& options, const Skeleton& skeleton) {
  if constexpr (!draws_effects) {
    std::string names;
    for (const Effect effect : all_effects) {
      if (std::ranges::count(skeleton.effects, effect_name_in_pack(effect)) == 0) continue;
      names += (names.empty() ? "" : ", ") + std::string(effect_name(effect));
    }
    if (!names.empty())
      notice("{} calls for {}: this program was built without effects, and draws it as with --effects none",
             options.pack.string(), names);
  }
}

Sky sky_of(const RunOptions& options, const Skeleton& skeleton) {
  if (!options.moment) return {};
  if (!skeleton.geo_place)
    fail("--date", "{} does not say where on Earth it stands: build it with --place LAT,LON",
         options.pack.string());
  return sky_over(*skeleton.geo_place, *options.moment);
}

Hiding load_hiding(const RunOptions& options, const Pack& pack) {
  if (options.hide.empty() && options.isolate.empty()) return {};
  const PackObjects objects = pack.read_objects();
  const SourceObjects& source = objects.source();
  const ObjectFinder finder(source);
  const auto meant = [&](const std::vector<std::string>& words, const std::string& flag) {
    std::vector<SourceObjectId> found;
    for (const std::string& word : words) {
      const std::vector<SourceObjectId> more = finder.require(word, flag);
      found.insert(found.end(), more.begin(), more.end());
    }
    return with_contents(source, found);
  };
  ObjectSet hidden = meant(options.hide, "--hide");
  if (!options.isolate.empty()) hidden = united(hidden, all_but(source, meant(options.isolate, "--isolate")));
  return hide(pack.skeleton(), objects, std::move(hidden), pack.name());
}

std::vector<FrameRequest> load_frames(const RunOptions& options, const Pack& pack) {
  std::vector<FrameRequest> frames = load_frames(options, pack.skeleton());
  const Hiding hiding = load_hiding(options, pack);
  for (FrameRequest& frame : frames) frame.state.hiding = hiding;
  return frames;
}

std::vector<FrameRequest> load_frames(const RunOptions& options, const Skeleton& skeleton) {
  say_effects_left_out(options, skeleton);
  const Path path = load_path(options.path);
  const size_t count = options.frames > 0 ? std::min(options.frames, path.frames.size()) : path.frames.size();
  std::vector<FrameRequest> frames;
  const double near = skeleton.default_near();
  const Sky sky = sky_of(options, skeleton);
  for (size_t i = 0; i < count; i += options.every) {
    const View view = path.view(i, options.size.width, options.size.height, near);
    check_view(view, skeleton, fmt::format("{} frame {}", options.path.string(), i));
    frames.push_back({static_cast<uint32_t>(i),
                      {view,
                       options.pixel_error(),
                       options.samples,
                       options.edges,
                       options.section,
                       {},
                       options.effects,
                       path.frames[i].time_seconds.value_or(options.time),
                       sky}});
  }
  return frames;
}

}  // namespace triptych
