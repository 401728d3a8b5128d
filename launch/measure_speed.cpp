#include "base/error.hpp"
#include "launch/choice_flag.hpp"
#include "launch/hide_flags.hpp"
#include "launch/measure.hpp"
#include "launch/number_flags.hpp"
#include "launch/section_flags.hpp"
#include "launch/text_table.hpp"
#include "measure/json.hpp"
#include "measure/speed.hpp"
#include "nodes/pack_device.hpp"
#include "session/open_pack.hpp"

#include <algorithm>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <memory>
#include <optional>

namespace triptych {

namespace {

std::string samples_in_words(uint32_t samples) {
  return samples == 1 ? "one sample" : fmt::format("{} samples", samples);
}

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
  fmt::print(
      "{} frames at {} and {} px, {} a pixel, in turn, after {} of warm-up. frame ms and CPU ms are medians, "
      "triangles a mean;\n"
      "ratios are medians over frames, but p95_over_median is of triptych's frame times\n",
      report["frames"].get<size_t>(), report["size"].get<std::string>(), report["pixel_error"].get<double>(),
      samples_in_words(report["samples"].get<uint32_t>()), report["warm_up"].get<size_t>());
}

/// The device that was asked for and, where a method wants it and the machine has it, the other one beside
/// it.
class MeasuredDevices {
 public:
  MeasuredDevices(const Pack& pack, const DeviceOptions& wanted, const std::vector<std::string>& methods)
      : asked_(choose_device(wanted)) {
    DeviceOptions other = asked_.options;
    other.kind = other.kind == DeviceKind::gl ? DeviceKind::cpu : DeviceKind::gl;
    const bool everything = std::count(methods.begin(), methods.end(), "everything") > 0;
    if (needs_devices(methods) || (everything && other.kind == DeviceKind::gl)) {
      try {
        other_ = choose_device(other);
      } catch (const Error& error) {
        no_opengl_ = error.what();
      }
    }
    if (!needs_devices(methods)) return;
    packs_.push_back(std::make_unique<PackDevice>(pack, asked_.options));
    if (other_) packs_.push_back(std::make_unique<PackDevice>(pack, other_->options));
  }

  const std::string& name() const { return device_name(asked_.options.kind); }
  /// Those that methods of devices are measured on.
  std::vector<SpeedDevice> list() const {
    std::vector<SpeedDevice> found;
    for (size_t i = 0; i < packs_.size(); ++i) {
      const DeviceKind kind = i == 0 ? asked_.options.kind : other_->options.kind;
      found.push_back({device_name(kind), packs_[i]->hierarchy(), packs_[i]->device()});
    }
    return found;
  }
  /// Says why there is no OpenGL; empty where there is.
  const std::string& no_opengl() const { return no_opengl_; }
  /// What OpenGL says of itself; null without it.
  const DeviceNames* opengl() const {
    if (asked_.options.kind == DeviceKind::gl) return &asked_.names;
    return other_ ? &other_->names : nullptr;
  }

 private:
  /// Whether any of the methods draws with each device.
  static bool needs_devices(const std::vector<std::string>& methods) {
    return methods.empty() || std::any_of(methods.begin(), methods.end(), [](const std::string& method) {
             return method != "everything" && method != "embree";
           });
  }

  ChosenDevice asked_;
  std::optional<ChosenDevice> other_;
  std::string no_opengl_;
  std::vector<std::unique_ptr<PackDevice>> packs_;
};

int run(const MeasureSpeedCommand& command) {
  const Pack pack = open_pack(command.run.pack);
  const std::vector<FrameRequest> frames = load_frames(command.run, pack);
  if (frames.empty()) fail(command.run.path.string(), "there is no frame to measure");
  const MeasuredDevices measured(pack, command.run.device, command.speed.methods);
  SpeedOptions options = command.speed;
  options.no_opengl = measured.no_opengl();
  const std::vector<SpeedDevice> devices = measured.list();
  const std::vector<SpeedSeries> series = measure_speed(pack, devices, frames, options);
  const size_t warm_up = std::min(command.speed.warm_up, frames.size() - 1);
  nlohmann::json report = {{"rows", speed_rows(series)},
                           {"ratios", speed_ratios(series, measured.name())},
                           {"device", measured.name()},
                           {"frames", frames.size() - warm_up},
                           {"warm_up", warm_up},
                           {"size", fmt::format("{}x{}", command.run.size.width, command.run.size.height)},
                           {"pixel_error", command.run.pixel_error()},
                           {"samples", command.run.samples},
                           {"triangles", pack.skeleton().placed_triangles}};
  report["section"] = section_json(command.run.section);
  add_hidden(report, frames.front().state.hiding.name);
  if (const DeviceNames* gl = measured.opengl()) report["gl"] = opengl_json(*gl);
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
  add_samples_flag(*sub, command->run);
  add_section_flags(*sub, command->run.section);
  add_hide_flags(*sub, command->run);
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
