#include "measure/role_times.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
#include "nodes/local_pipeline.hpp"
#include "nodes/recorded_peers.hpp"
#include "nodes/render_node.hpp"
#include "nodes/replay.hpp"
#include "nodes/switch_node.hpp"

#include <algorithm>

namespace triptych {

namespace {

RoleRecording read_role(Role role, const std::filesystem::path& folder) {
  const auto files = recordings_of(role, folder);
  if (files.empty()) fail(folder.string(), "holds no recording of {}", role_name(role));
  if (files.size() > 1)
    fail(files[1].string(), "the role was started again: record a session in which none is");
  RecordingReader reader(files[0]);
  RoleRecording recording{role, files[0].string(), reader.header(), {}};
  while (auto message = reader.next()) recording.messages.push_back(std::move(*message));
  return recording;
}

/// Frames that the render node drew alone are messages from itself.
void check_is_one_epoch(const RoleRecording& recording) {
  std::optional<uint32_t> last;
  for (const RecordedMessage& recorded : recording.messages) {
    const auto* camera = std::get_if<CameraMessage>(&recorded.message);
    if (camera == nullptr || camera->warm_up) continue;
    if (recording.role == Role::render && recorded.peer == Role::render)
      fail(recording.file, "frame {} was drawn without switch nodes: record with --gather", camera->frame);
    // The render node sends each to both.
    if (last && camera->frame != *last && camera->frame != *last + 1)
      fail(recording.file, "the camera of frame {} is not there", *last + 1);
    last = camera->frame;
  }
}

class RecordedFrames final : public FrameSource {
 public:
  explicit RecordedFrames(const std::vector<FrameRequest>& frames) : frames_(frames) {}
  Numbers numbers() const override { return {frames_.front().number, frames_.back().number + 1}; }
  FrameRequest next(uint32_t number) override { return frames_.at(number - frames_.front().number); }

 private:
  const std::vector<FrameRequest>& frames_;
};

class FrameTimes final : public FrameSink {
 public:
  void picture(FrameRecord record, const FrameTarget&) override {
    alone_ = alone_ || record.fallback;
    times_.push_back(record.frame_ms);
  }
  bool alone() const { return alone_; }
  std::vector<double> take() { return std::move(times_); }

 private:
  bool alone_ = false;
  std::vector<double> times_;
};

/// Long enough for any frame: peers here are as fast as the role.
constexpr std::chrono::milliseconds no_limit{600'000};

}  // namespace

std::vector<RoleRecording> read_session_recording(const std::filesystem::path& folder) {
  std::vector<RoleRecording> roles;
  for (const Role role : all_roles) roles.push_back(read_role(role, folder));
  for (const RoleRecording& recording : roles) {
    if (recording.header.own.session != roles.front().header.own.session)
      fail(recording.file, "is of another session than {}", roles.front().file);
    check_is_one_epoch(recording);
  }
  return roles;
}

std::vector<FrameRequest> recorded_frames(const Pack& pack, const RoleRecording& render) {
  Replay replay(pack, render.file);
  std::vector<FrameRequest> frames;
  for (const RecordedMessage& message : render.messages) {
    for (const ReplayedFrame& frame : replay.take(message)) frames.push_back(frame.request);
  }
  if (frames.empty()) fail(render.file, "holds no frame");
  return frames;
}

SwitchNodeTimes time_switch_node(const Pack& pack, const RoleRecording& recording,
                                 const DeviceOptions& device, StrategyKind strategy) {
  SwitchNodeTimes times;
  RecordedPeers peers(recording.role, recording.messages, recording.file,
                      [&](const RecordedMessage& message) {
                        // Both peers get the sentinel, the render node alone the report.
                        if (!message.sent || message.peer != Role::render) return;
                        if (const auto* sentinel = std::get_if<Sentinel>(&message.message))
                          times.hardware_cull.push_back(sentinel->times.hardware_cull_ms);
                        if (const auto* report = std::get_if<SwitchReport>(&message.message))
                          times.occlusion_representation.push_back(report->occlusion_representation_ms);
                      });
  EpochSink sink;
  run_switch_node(pack, recording.role, sink,
                  {.device = device,
                   .strategy = strategy,
                   .connect = [&](bool again) { return again ? nullptr : peers.connect(); },
                   .stop = [&] { return peers.failed() || stop_requested(); }});
  if (stop_requested()) return {};
  peers.finish();
  return times;
}

std::vector<double> time_render_node(const Pack& pack, const RoleRecording& recording,
                                     const std::vector<FrameRequest>& frames, const DeviceOptions& device) {
  RecordedPeers peers(recording.role, recording.messages, recording.file, [](const RecordedMessage&) {});
  RecordedFrames source(frames);
  FrameTimes sink;
  std::atomic<bool> connected{false};
  run_render_node(
      pack, source, sink,
      {.timeout = no_limit,
       .gather = no_limit,
       .device = device,
       .connect =
           [&](const std::function<bool()>&) { return connected.exchange(true) ? nullptr : peers.connect(); },
       .stop = [&] { return peers.failed() || stop_requested(); }});
  if (stop_requested()) return {};
  peers.finish();
  if (sink.alone()) fail(recording.file, "the render node did not take what it took in the session");
  return sink.take();
}

std::vector<double> time_local_pipeline(const Pack& pack, const std::vector<FrameRequest>& frames,
                                        const DeviceOptions& device, StrategyKind strategy) {
  const View& first = frames.front().state.view;
  LocalPipeline pipeline(pack,
                         {.width = first.width, .height = first.height, .cull = strategy, .device = device});
  pipeline.draw(frames.front());  // roles warm up with it
  pipeline.resume({});
  std::vector<double> times;
  for (const FrameRequest& frame : frames) {
    if (stop_requested()) return {};
    const View& view = frame.state.view;
    if (pipeline.target().width() != view.width || pipeline.target().height() != view.height)
      pipeline.resize(view.width, view.height);
    const Stopwatch watch;
    pipeline.draw(frame);
    times.push_back(watch.milliseconds());
  }
  return times;
}

}  // namespace triptych
