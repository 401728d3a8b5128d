#include "base/error.hpp"
#include "base/file.hpp"
#include "base/notice.hpp"
#include "launch/choice_flag.hpp"
#include "launch/measure.hpp"
#include "launch/named_files.hpp"
#include "launch/number_flags.hpp"
#include "launch/text_table.hpp"
#include "measure/accuracy/accuracy_json.hpp"
#include "measure/accuracy/accuracy_pictures.hpp"
#include "measure/accuracy/butteraugli.hpp"
#include "measure/json.hpp"
#include "nodes/pack_device.hpp"
#include "report/accuracy_page.hpp"
#include "session/temporary_folder.hpp"
#include "visibility/strategies.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <memory>

namespace triptych {

namespace {

struct MeasureAccuracyCommand {
  RunOptions run;
  std::vector<std::filesystem::path> others;
  std::vector<PictureSize> sizes;
  std::vector<std::string> devices, strategies;
  std::filesystem::path output;
  const CLI::App* words = nullptr;  ///< what was parsed
  std::vector<uint32_t> min_pixels = {4, 16};
  AccuracyOptions options;
};

std::vector<std::string> all_strategies() {
  std::vector<std::string> names;
  for (const auto& [name, kind] : strategy_names()) names.push_back(name);
  return names;
}

/// Each value once, where it comes first.
template <typename Value>
std::vector<Value> each_once(const std::vector<Value>& values) {
  std::vector<Value> once;
  for (const Value& value : values) {
    if (std::count(once.begin(), once.end(), value) == 0) once.push_back(value);
  }
  return once;
}

/// Every strategy there is, or those of the given names.
std::vector<AccuracyStrategy> strategies_of(const MeasureAccuracyCommand& command) {
  std::vector<AccuracyStrategy> found;
  for (const auto& [name, kind] : strategy_names()) {
    const std::vector<std::string>& wanted = command.strategies;
    if (!wanted.empty() && std::count(wanted.begin(), wanted.end(), name) == 0) continue;
    for (const uint32_t pixels :
         counts_pixels(kind) ? each_once(command.min_pixels) : std::vector<uint32_t>{0}) {
      StrategyOptions options;
      if (pixels > 0) options.min_pixels = pixels;
      found.push_back({name, pixels, [kind = kind, options](const Hierarchy& hierarchy) {
                         return make_strategy(kind, hierarchy, options);
                       }});
    }
  }
  return found;
}

/// The devices that were asked for; contexts are made once.
std::vector<ChosenDevice> choose_devices(const MeasureAccuracyCommand& command) {
  std::vector<ChosenDevice> chosen;
  if (command.devices.empty()) chosen.push_back(choose_device(command.run.device));
  for (const std::string& name : each_once(command.devices)) {
    DeviceOptions wanted = command.run.device;
    wanted.kind = name == device_name(DeviceKind::gl) ? DeviceKind::gl : DeviceKind::cpu;
    chosen.push_back(choose_device(wanted));
  }
  return chosen;
}

/// The packs in the order of the command line, and what draws them.
class Subjects {
 public:
  Subjects(const MeasureAccuracyCommand& command, const std::vector<ChosenDevice>& chosen) {
    open(command.run.pack);
    for (const std::filesystem::path& other : command.others) {
      open(other);
      const uint64_t here = packs_.back()->skeleton().source_triangles,
                     first = packs_.front()->skeleton().source_triangles;
      if (here != first)
        fail(other.string(), "is a pack of another model: {} source triangles, and {} has {}", here,
             command.run.pack.string(), first);
    }
    for (const auto& pack : packs_) {
      std::vector<SpeedDevice> devices;
      for (const ChosenDevice& device : chosen) {
        devices_.push_back(std::make_unique<PackDevice>(*pack, device.options));
        devices.push_back(
            {device_name(device.options.kind), devices_.back()->hierarchy(), devices_.back()->device()});
      }
      subjects_.push_back({std::filesystem::path(pack->name()).filename().string(),
                           devices_.back()->representation().name(), *pack, devices});
    }
  }
  const std::vector<AccuracySubject>& list() const { return subjects_; }
  const Skeleton& skeleton() const { return packs_.front()->skeleton(); }

 private:
  void open(const std::filesystem::path& file) { packs_.push_back(std::make_unique<Pack>(file)); }

  std::vector<std::unique_ptr<Pack>> packs_;
  std::vector<std::unique_ptr<PackDevice>> devices_;
  std::vector<AccuracySubject> subjects_;
};

std::vector<std::vector<FrameRequest>> frames_of(const MeasureAccuracyCommand& command,
                                                 const Skeleton& skeleton) {
  std::vector<PictureSize> sizes = command.sizes;
  if (sizes.empty()) sizes.push_back(command.run.size);
  std::vector<std::vector<FrameRequest>> frames;
  for (const PictureSize& size : sizes) {
    RunOptions run = command.run;
    run.size = size;
    frames.push_back(load_frames(run, skeleton));
  }
  if (frames.front().empty()) fail(command.run.path.string(), "there is no frame to measure");
  return frames;
}

void print(const nlohmann::json& report, bool perceptual) {
  for (const nlohmann::json& row : report["rows"]) {
    std::string name = row["strategy"].get<std::string>();
    if (!row["min_pixels"].is_null()) name += fmt::format(" {}", row["min_pixels"].get<uint32_t>());
    fmt::print("{} on {}, {}, {}: {}\n", name, row["device"].get<std::string>(),
               row["size"].get<std::string>(), row["pack"].get<std::string>(),
               row["says"].get<std::string>());
  }
  fmt::print("{} frames timed in turn, {} compared; times are medians\n", report["frames"].get<size_t>(),
             report["rows"][0]["compared_frames"].get<size_t>());
  if (!perceptual) fmt::print("butteraugli was not measured: install the package {}\n", Butteraugli::package);
  for (const nlohmann::json& violation : report["violated"]) {
    const nlohmann::json& row = report["rows"][violation["row"].get<size_t>()];
    fmt::print(stderr, "{} at {:g} px, frame {}: {}", row["strategy"].get<std::string>(),
               row["pixel_error"].get<double>(), violation["frame"].get<uint32_t>(),
               violation["what"].get<std::string>());
    if (violation.contains("drawable"))
      fmt::print(stderr, ", of drawable {} at {}", violation["drawable"].get<DrawableId>(),
                 json_text(violation["place"]));
    fmt::print(stderr, "\n");
  }
}

int run(const MeasureAccuracyCommand& command) {
  make_folder(command.output);
  const std::vector<ChosenDevice> chosen = choose_devices(command);
  const Subjects subjects(command, chosen);
  const auto frames = frames_of(command, subjects.skeleton());
  const TemporaryFolder scratch;
  AccuracyOptions options = command.options;
  options.pixel_errors = each_once(command.run.pixel_errors);
  options.strategies = strategies_of(command);
  options.scratch = scratch.path();
  const AccuracyResult result = measure_accuracy(subjects.list(), frames, options);
  nlohmann::json report = accuracy_json(result);
  report["frames"] = frames.front().size();
  report["triangles"] = subjects.skeleton().placed_triangles;
  report["title"] = fmt::format("What accuracy costs: {}", command.run.pack.filename().string());
  report["command"] = command_line(*command.words);
  for (const ChosenDevice& device : chosen) {
    if (device.options.kind == DeviceKind::gl) report["gl"] = opengl_json(device.names);
  }
  report.update(write_accuracy_pictures(result, command.output));
  write_file(command.output / "accuracy.csv", accuracy_csv(report));
  write_file(command.output / "report.html", accuracy_page(report));
  write_json(command.output / "accuracy.json", report);
  write_json(command.run.json, report);
  print(report, result.perceptual);
  fmt::print("{}: charts, pictures and all figures\n", (command.output / "report.html").string());
  const auto violations = report["violations"].get<size_t>();
  if (violations > 0)
    notice("triptych: accuracy: {} promises were broken; {} names them", violations,
           (command.output / "report.html").string());
  return violations == 0 ? 0 : 1;
}

}  // namespace

void add_measure_accuracy(CLI::App& measure, Action& action) {
  auto command = std::make_shared<MeasureAccuracyCommand>();
  CLI::App* sub = measure.add_subcommand(
      "accuracy", "What each pixel of error costs in time, and what it spoils in pictures");
  sub->footer("Example: triptych measure accuracy scene.tpk --path walk.json -o accuracy");
  command->run.pixel_errors = {0.25, 0.5, 1, 2, 4, 8, 16, 32};
  command->words = sub;
  add_run_flags(*sub, command->run);
  take_list(sub->get_option("--pixel-error"))->default_str("0.25,0.5,1,2,4,8,16,32")->type_name("PX,...");
  sub->add_option("-o,--output", command->output,
                  "Folder for accuracy.json, accuracy.csv, report.html and pictures")
      ->required()
      ->type_name("DIR");
  take_list(sub->add_option("--with", command->others, "Further packs of the same model, built otherwise"))
      ->type_name("FILE.tpk,...");
  take_list(sub->add_option("--strategies", command->strategies,
                            fmt::format("Only these of {}", fmt::join(all_strategies(), ", "))))
      ->check(one_of(all_strategies()))
      ->type_name("NAME,...");
  take_list(sub->add_option("--devices", command->devices, "Measure on each of these: cpu, gl"))
      ->check(one_of({device_name(DeviceKind::cpu), device_name(DeviceKind::gl)}))
      ->type_name("NAME,...");
  take_list(sub->add_option("--min-pixels", command->min_pixels,
                            "What approximate strategies may leave out: what owns fewer pixels"))
      ->check(whole_number(1, 1'000'000))
      ->default_str("4,16")
      ->type_name("N,...");
  add_sizes_flag(*sub, command->sizes);
  sub->add_option("--compare", command->options.compared_frames,
                  "Compare so many frames, spread over the path; all are timed")
      ->check(whole_number(1, max_frames))
      ->capture_default_str();
  sub->add_option("--points", command->options.points,
                  "Pixels of a picture at which distances are measured, each way; 0: all")
      ->check(whole_number(0, max_frames))
      ->capture_default_str();
  sub->add_option("--shifts", command->options.shifts,
                  "Shifts of the camera over which the cover of small things is averaged; 0: not measured")
      ->check(whole_number(0, 64))
      ->capture_default_str();
  sub->callback([command, &action] { action = [command] { return run(*command); }; });
}

}  // namespace triptych
