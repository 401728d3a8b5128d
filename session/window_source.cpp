#include "session/window_source.hpp"

#include <algorithm>
#include <limits>

namespace triptych {

ViewerOptions viewer_options(const RunOptions& run, const Pack& pack) {
  ViewerOptions options;
  options.window.title = run.pack.filename().string();
  options.window.width = run.size.width;
  options.window.height = run.size.height;
  options.pixel_error = run.pixel_error();
  options.samples = run.samples;
  options.edges = run.edges;
  options.effects = run.effects;
  options.time = run.time;
  options.sky = sky_of(run, pack.skeleton());
  options.hiding = load_hiding(run, pack);
  if (run.path.empty()) say_effects_left_out(run, pack.skeleton());
  options.section = run.section;
  if (run.path.empty()) return options;
  options.path = load_path(run.path);
  auto& frames = options.path->frames;
  if (run.frames > 0) frames.resize(std::min(frames.size(), run.frames));
  return options;
}

FrameSource::Numbers WindowSource::numbers() const { return {first_, std::numeric_limits<uint32_t>::max()}; }

FrameRequest WindowSource::next(uint32_t number) {
  FrameRequest frame = viewer_.next_frame();
  frame.number = number;
  return frame;
}

bool WindowSource::ready(bool may_wait) {
  constexpr double patience_s = 0.05;
  return viewer_.wait_for_frame(may_wait ? patience_s : 0);
}

void WindowSource::say_alone(const std::string& reason) {
  const size_t name_end = reason.find(" lost: ");  // "switch node 1 lost: connection closed"
  viewer_.say_alone(name_end != std::string::npos ? reason.substr(0, name_end) + " is gone: drawing alone"
                                                  : "drawing alone: " + reason);
}

void WindowSource::show(const FrameRequest& frame, const FrameRecord& record, LocalPipeline& stages) {
  if (!record.fallback) say_together();
  if (record.fallback && !record.lost.empty()) say_alone(record.lost);
  if (viewer_.culling()) return viewer_.show(frame, record, stages.target(), stages.device());
  const View& view = frame.state.view;
  if (!whole_cut_ || whole_cut_->target().width() != view.width ||
      whole_cut_->target().height() != view.height) {
    whole_cut_.emplace(stages.device(), view.width, view.height);
  }
  FrameRecord uncut = record;
  const FrameView frame_view(stages.hierarchy().skeleton(), frame.state, stages.rules());
  uncut.visible = select_cut(frame_view).drawables;
  uncut.cut_drawables = uncut.visible.size();
  whole_cut_->begin(frame_view, frame.number);
  whole_cut_->draw(uncut.visible);
  whole_cut_->finish();
  std::sort(uncut.visible.begin(), uncut.visible.end());
  uncut.drawn_triangles = whole_cut_->drawn_triangles();
  viewer_.show(frame, uncut, whole_cut_->target(), stages.device());
}

}  // namespace triptych
