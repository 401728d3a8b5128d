#include "measure/speed.hpp"

#include "base/clock.hpp"
#include "base/memory.hpp"
#include "base/progress.hpp"
#include "base/signals.hpp"
#include "base/spent_time.hpp"
#include "measure/model_methods.hpp"
#include "nodes/device_choice.hpp"

#include <algorithm>
#include <fmt/core.h>
#include <optional>

namespace triptych {

namespace {

/// Everything that is measured together, in the order of the rows.
class Contest {
 public:
  Contest(const Pack& pack, std::span<const SpeedDevice> devices, std::span<const FrameRequest> frames,
          const SpeedOptions& options)
      : frames_(frames), options_(options) {
    add_model_methods(pack);
    owners_.reserve(devices.size());
    for (const SpeedDevice& device : devices) {
      // The pass loads every chunk that the path draws, for all methods.
      owners_.push_back(owners_of_frames(device, frames));
      if (wants("frustum")) add(make_frustum_method(device, frames));
      if (wants("frustum-hidepth") && device.name == device_name(DeviceKind::cpu))
        add(make_frustum_hidepth_method(device, frames));
      if (wants("triptych")) add(make_triptych_method(device, frames));
      if (wants("oracle")) add(make_oracle_method(device, frames, owners_.back()));
    }
  }

  std::vector<SpeedSeries> run() {
    const size_t warm_up = std::min(options_.warm_up, frames_.size() - 1);
    Progress progress("measure speed", frames_.size());
    for (size_t frame = 0; frame < frames_.size(); ++frame) {
      for (size_t turn = 0; turn < methods_.size(); ++turn) {
        const size_t which = (turn + frame) % methods_.size();
        const SpeedSeries::Frame measured = measure(*methods_[which], frame);
        if (frame >= warm_up) series_[place_[which]].frames.push_back(measured);
      }
      progress.advance();
      end_if_asked("measure speed");
    }
    return std::move(series_);
  }

 private:
  bool wants(const std::string& method) const {
    const std::vector<std::string>& wanted = options_.methods;
    return wanted.empty() || std::count(wanted.begin(), wanted.end(), method) > 0;
  }

  void add(std::unique_ptr<SpeedMethod> method) {
    place_.push_back(series_.size());
    series_.push_back({.method = method->name(), .device = method->device()});
    methods_.push_back(std::move(method));
  }
  void add_unfit(const std::string& method, const std::string& device, uint64_t bytes, uint64_t room) {
    if (!wants(method)) return;
    series_.push_back(
        {.method = method,
         .device = device,
         .missing = fmt::format("needs more than {} bytes of memory, and there are {}", bytes, room)});
  }

  void add_model_methods(const Pack& pack) {
    if (!options_.no_opengl.empty() && wants("everything"))
      series_.push_back({.method = "everything", .device = "gl", .missing = options_.no_opengl});
    const bool everything = options_.no_opengl.empty() && wants("everything");
    if (!everything && !wants("embree")) return;
    const HiddenObjects* const hidden = frames_.front().state.hiding.objects.get();
    const uint64_t model_bytes = flat_model_size(pack.skeleton(), hidden).bytes();
    const auto room = [&] { return std::min(available_memory_bytes(), options_.max_memory_bytes); };
    // OpenGL and Embree each take about as much again.
    if (2 * model_bytes > room()) {
      if (everything) add_unfit("everything", "gl", 2 * model_bytes, room());
      add_unfit("embree", "", 2 * model_bytes, room());
      return;
    }
    // Where what moves is in the first frame: it has no other place in a flat model.
    model_.emplace(flatten(pack, hidden, poses_of(pack.skeleton(), frames_.front().state).get()));
    if (everything) add(make_everything_method(*model_, pack.skeleton(), frames_));
    if (!wants("embree")) return;
    const uint64_t room_for_tree = room();
    if (auto embree = make_embree_method(*model_, frames_, room_for_tree)) {
      add(std::move(embree));
    } else {
      add_unfit("embree", "", room_for_tree, room_for_tree);
    }
  }

  static SpeedSeries::Frame measure(SpeedMethod& method, size_t frame) {
    method.prepare(frame);
    const double cpu_before = process_cpu_milliseconds();
    const Stopwatch stopwatch;
    method.draw(frame);
    const double frame_ms = stopwatch.milliseconds();
    return {.frame_ms = frame_ms,
            .cpu_ms = process_cpu_milliseconds() - cpu_before,
            .drawn_triangles = method.drawn_triangles(),
            .stages = method.stages()};
  }

  std::span<const FrameRequest> frames_;
  const SpeedOptions& options_;
  std::optional<FlatModel> model_;
  std::vector<std::vector<VisibleSet>> owners_;  ///< by device and frame
  std::vector<std::unique_ptr<SpeedMethod>> methods_;
  std::vector<size_t> place_;  ///< of each method its series
  std::vector<SpeedSeries> series_;
};

}  // namespace

const std::vector<std::string>& speed_method_names() {
  static const std::vector<std::string> names = {"everything", "frustum", "frustum-hidepth",
                                                 "triptych",   "oracle",  "embree"};
  return names;
}

std::vector<SpeedSeries> measure_speed(const Pack& pack, std::span<const SpeedDevice> devices,
                                       std::span<const FrameRequest> frames, const SpeedOptions& options) {
  return Contest(pack, devices, frames, options).run();
}

}  // namespace triptych
