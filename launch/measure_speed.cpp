#include "base/error.hpp"
#include "launch/choice_flag.hpp"
#include "launch/measure.hpp"
#include "launch/number_flags.hpp"
#include "launch/text_table.hpp"
#include "measure/json.hpp"
#include "measure/speed.hpp"
#include "nodes/pack_device.hpp"

#include <algorithm>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <memory>

namespace triptych {

namespace {

struct MeasureSpeedCommand {
  RunOptions run;
  SpeedOptions speed;
};

void print(const nlohmann::json& report) {
  std::vector<std::vector<std::string>> lines;
  for (const nlohmann::json& row : report["rows"]) {
    std::vector<std::string> line = {row["method"].get<std::string>(), row.value("device", "-")};
    const auto cell = [&](const char* figure, const char* which, int decimals) {
      line.push_back(row[figure].is_null() ? "-" : in_threes(row[figure][which].get<double>(), decimals));
    };
    cell("frame_ms", "p50", 2);
    cell("frame_ms", "p95", 2);
    cell("frame_ms", "max", 2);
    cell("cpu_ms", "p50", 2);
    cell("drawn_triangles", "mean", 0);
    lines.push_back(line);
  }
  fmt::print("{}", text_table({"method", "device", "frame ms", "p95", "max", "CPU ms", "triangles"}, lines));
  for (const nlohmann::json& row : report["rows"]) {
    if (row.contains("why"))
      fmt::print("{}: {}\n", row["method"].get<std::string>(), row["why"].get<std::string>());
  }
  for (const auto& [name, ratio] : report["ratios"].items())
    fmt::print("{:<31}{:>9.3f}\n", name, ratio.get<double>());
  fmt::print("{} frames at {} and {} px, in turn, after {} of warm-up; ratios are medians of pairs\n",
             report["frames"].get<size_t>(), report["size"].get<std::string>(),
             report["pixel_error"].get<double>(), report["warm_up"].get<size_t>());
}

/// The device that was asked for, and the other one beside it; of both, OpenGL's context.
class MeasuredDevices {
 public:
  MeasuredDevices(const Pack& pack, const DeviceOptions& wanted)
      : asked_(choose_device(wanted)), other_(choose_device(other_than(asked_.options))) {
    for (const ChosenDevice* chosen : {&asked_, &other_})
      devices_.push_back(std::make_unique<PackDevice>(pack, chosen->options));
  }
  std::vector<SpeedDevice> list() const {
    return {{device_name(asked_.options.kind), devices_[0]->hierarchy(), devices_[0]->device()},
            {device_name(other_.options.kind), devices_[1]->hierarchy(), devices_[1]->device()}};
  }

 private:
  static DeviceOptions other_than(DeviceOptions options) {
    options.kind = options.kind == DeviceKind::gl ? DeviceKind::cpu : DeviceKind::gl;
    return options;
  }

  ChosenDevice asked_, other_;
  std::vector<std::unique_ptr<PackDevice>> devices_;
};

int run(const MeasureSpeedCommand& command) {
  const Pack pack(command.run.pack);
  const std::vector<FrameRequest> frames = load_frames(command.run, pack.skeleton());
  if (frames.empty()) fail(command.run.path.string(), "there is no frame to measure");
  const MeasuredDevices measured(pack, command.run.device);
  const std::vector<SpeedDevice> devices = measured.list();
  const std::vector<SpeedSeries> series = measure_speed(pack, devices, frames, command.speed);
  const size_t warm_up = std::min(command.speed.warm_up, frames.size() - 1);
  const nlohmann::json report = {
      {"rows", speed_rows(series)},
      {"ratios", speed_ratios(series, devices.front().name)},
      {"device", devices.front().name},
      {"frames", frames.size() - warm_up},
      {"warm_up", warm_up},
      {"size", fmt::format("{}x{}", command.run.size.width, command.run.size.height)},
      {"pixel_error", command.run.pixel_error()},
      {"triangles", pack.skeleton().placed_triangles}};
  print(report);
  write_json(command.run.json, report);
  return 0;
}

}  // namespace

void add_measure_speed(CLI::App& measure, Action& action) {
  auto command = std::make_shared<MeasureSpeedCommand>();
  CLI::App* sub = measure.add_subcommand(
      "speed", "Frames beside other ways of drawing them: all triangles, an oracle, a ray tracer");
  sub->footer("Example: triptych measure speed scene.tpk --path walk.json --json speed.json");
  add_run_flags(*sub, command->run);
  take_list(sub->add_option("--methods", command->speed.methods,
                            fmt::format("Only these of {}", fmt::join(speed_method_names(), ", "))))
      ->check(one_of(speed_method_names()))
      ->type_name("NAME,...");
  sub->add_option("--warm-up", command->speed.warm_up, "Frames of the path that are drawn and left out first")
      ->check(whole_number(0, max_frames))
      ->capture_default_str();
  sub->callback([command, &action] { action = [command] { return run(*command); }; });
}

}  // namespace triptych
