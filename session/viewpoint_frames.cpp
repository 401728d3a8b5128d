#include "session/viewpoint_frames.hpp"

#include "base/error.hpp"
#include "base/notice.hpp"
#include "scene/pack_objects.hpp"
#include "view/viewpoint.hpp"

#include <algorithm>

namespace triptych {

namespace {

std::string place_of(const std::filesystem::path& bcf, size_t index) {
  return fmt::format("{}: viewpoint {}", bcf.string(), index + 1);
}

void say_left_out(const Viewpoint& viewpoint, const SourceObjects& source, const std::string& place) {
  const std::string what = left_out_text(viewpoint, source);
  if (!what.empty()) notice("{}: not shown: {}", place, what);
}

/// What the viewpoint hides, and what was hidden already.
Hiding hiding_of(const Viewpoint& viewpoint, const Hiding& already, const Skeleton& skeleton,
                 const PackObjects& objects, const std::string& place) {
  ObjectSet hidden = hidden_by(viewpoint, objects.source());
  if (already.objects) hidden = united(hidden, already.objects->objects());
  return hide(skeleton, objects, std::move(hidden), place);
}

}  // namespace

std::vector<FrameRequest> viewpoint_frames(const std::filesystem::path& bcf, const RunOptions& options,
                                           const Pack& pack) {
  const std::vector<Viewpoint> viewpoints = read_bcf(bcf);
  const Skeleton& skeleton = pack.skeleton();
  const PackObjects objects = pack.read_objects();
  const Hiding already = load_hiding(options, pack);
  const size_t count = options.frames > 0 ? std::min(options.frames, viewpoints.size()) : viewpoints.size();
  const double near = skeleton.default_near(), least_height = skeleton.diagonal() * 1e-9;
  const Sky sky = sky_of(options, skeleton);
  std::vector<FrameRequest> frames;
  for (size_t i = 0; i < count; i += options.every) {
    const std::string place = place_of(bcf, i);
    const Viewpoint& viewpoint = viewpoints[i];
    if (const auto& height = viewpoint.camera.orthographic_height; height && *height < least_height)
      fail(place, "is {} metres high, which is too little for this model", *height);
    say_left_out(viewpoint, objects.source(), place);
    const View view = Path{{viewpoint.camera}}.view(0, options.size.width, options.size.height, near);
    frames.push_back(
        {static_cast<uint32_t>(i),
         {view, options.pixel_error(), options.samples, options.edges, section_of(viewpoint, place),
          hiding_of(viewpoint, already, skeleton, objects, place), options.effects, options.time, sky}});
  }
  return frames;
}

void begin_at_viewpoint(const FirstViewpoint& first, const Pack& pack, ViewerOptions& options, bool says) {
  if (first.bcf.empty()) return;
  const std::vector<Viewpoint> viewpoints = read_bcf(first.bcf);
  if (first.number > viewpoints.size())
    fail(first.bcf.string(), "has {} viewpoints, and no number {}", viewpoints.size(), first.number);
  const Viewpoint& viewpoint = viewpoints[first.number - 1];
  const std::string place = place_of(first.bcf, first.number - 1);
  const PackObjects objects = pack.read_objects();
  if (says) say_left_out(viewpoint, objects.source(), place);
  options.path = Path{{viewpoint.camera}};
  options.section = section_of(viewpoint, place);
  options.hiding = hiding_of(viewpoint, options.hiding, pack.skeleton(), objects, place);
  options.selected = viewpoint.selected;
}

}  // namespace triptych
