#include "base/error.hpp"
#include "base/file.hpp"
#include "base/notice.hpp"
#include "launch/accuracy_packs.hpp"
#include "launch/choice_flag.hpp"
#include "launch/hide_flags.hpp"
#include "launch/measure.hpp"
#include "launch/named_files.hpp"
#include "launch/number_flags.hpp"
#include "launch/print_accuracy.hpp"
#include "launch/section_flags.hpp"
#include "measure/accuracy/accuracy_json.hpp"
#include "measure/accuracy/accuracy_pictures.hpp"
#include "measure/accuracy/accuracy_words.hpp"
#include "measure/json.hpp"
#include "nodes/pack_device.hpp"
#include "nodes/pack_strategy.hpp"
#include "report/accuracy_page.hpp"
#include "scene/path.hpp"
#include "session/temporary_folder.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <map>
#include <memory>

namespace triptych {

namespace {

struct MeasureAccuracyCommand {
  RunOptions run;
  AccuracyPacks packs;
  std::vector<PictureSize> sizes;
  std::vector<uint32_t> samples;  ///< a pixel
  std::vector<std::string> devices, strategies;
  std::filesystem::path output;
  const CLI::App* words = nullptr;       ///< what was parsed
  const CLI::Option* compare = nullptr;  ///< its --compare
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
      const auto of_packs = std::make_shared<std::map<const Pack*, StrategyChoice>>();
      found.push_back({name, pixels, [=, kind = kind](const Pack& pack, const Hierarchy& hierarchy) {
                         auto choice = of_packs->find(&pack);
                         if (choice == of_packs->end())
                           choice = of_packs->emplace(&pack, choose_strategy(pack, kind, options)).first;
                         return make_strategy(choice->second.kind, hierarchy, choice->second.options);
                       }});
    }
  }
  return found;
}

/// Once the command line was parsed: a threshold beside strategies none of which counts.
void check_min_pixels(const CLI::App& command, const std::vector<std::string>& strategies) {
  if (command.count("--min-pixels") == 0 || strategies.empty()) return;
  for (const auto& [name, kind] : strategy_names()) {
    if (counts_pixels(kind) && std::count(strategies.begin(), strategies.end(), name) > 0) return;
  }
  throw CLI::ValidationError("--min-pixels",
                             "is of --strategies approximate: other strategies count no pixels");
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

/// The path at each size and with each number of samples.
std::vector<std::vector<FrameRequest>> frames_of(const MeasureAccuracyCommand& command,
                                                 const Skeleton& skeleton) {
  std::vector<PictureSize> sizes = command.sizes;
  if (sizes.empty()) sizes.push_back(command.run.size);
  std::vector<uint32_t> samples = each_once(command.samples);
  if (samples.empty()) samples.push_back(command.run.samples);
  std::vector<std::vector<FrameRequest>> frames;
  for (const PictureSize& size : sizes) {
    for (const uint32_t count : samples) {
      RunOptions run = command.run;
      run.size = size;
      run.samples = count;
      frames.push_back(load_frames(run, skeleton));
      // Distances are to surfaces where they stand: what moves is measured at rest.
      for (FrameRequest& frame : frames.back()) frame.state.time = 0;
    }
  }
  if (frames.front().empty()) fail(command.run.path.string(), "there is no frame to measure");
  return frames;
}

int run(const MeasureAccuracyCommand& command) {
  check_is_no_model_file({command.run.json}, command.packs.models);
  load_path(command.run.path);  // so that its errors are reported before anything is built
  const std::vector<ChosenDevice> chosen = choose_devices(command);
  const TemporaryFolder scratch;
  const AccuracySubjects subjects(named_packs(command.packs, command.run.pack, scratch.path()), chosen,
                                  command.run);
  const auto frames = frames_of(command, subjects.skeleton());
  if (command.compare->count() > 0 && command.options.compared_frames > frames.front().size())
    notice("triptych: accuracy: --compare {}: there are {} frames, and every one is compared",
           command.options.compared_frames, frames.front().size());
  AccuracyOptions options = command.options;
  options.pixel_errors = each_once(command.run.pixel_errors);
  options.strategies = strategies_of(command);
  options.scratch = scratch.path();
  const AccuracyResult result = measure_accuracy(subjects.list(), frames, options);
  nlohmann::json report = accuracy_json(result);
  const size_t path_frames = load_path(command.run.path).frames.size();
  report["frames"] = frames.front().size();
  report["path_frames"] = path_frames;
  report["every"] = command.run.every;
  report["frames_say"] = frames_in_words(frames.front().size(), path_frames, command.run.every);
  report["section"] = section_json(command.run.section);
  add_hidden(report, subjects.list().front().hiding.name);
  report["triangles"] = subjects.skeleton().placed_triangles;
  report["title"] = fmt::format(
      "What accuracy costs: {}",
      (command.run.pack.empty() ? command.packs.models.front() : command.run.pack).filename().string());
  report["command"] = command_line(*command.words);
  for (const ChosenDevice& device : chosen) {
    if (device.options.kind == DeviceKind::gl) report["gl"] = opengl_json(device.names);
  }
  // Not before there is something to put into it: a run that fails leaves no folder.
  report.update(write_accuracy_pictures(result, command.output));
  write_file(command.output / "accuracy.csv", accuracy_csv(report));
  write_file(command.output / "report.html", accuracy_page(report));
  write_json(command.output / "accuracy.json", report);
  write_json(command.run.json, report);
  print_accuracy(report, result.perceptual);
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
  sub->footer("Example: triptych measure accuracy scene.tpk --path walk.json --every 10 -o accuracy");
  command->run.pixel_errors = {0.25, 0.5, 1, 2, 4, 8, 16, 32};
  command->words = sub;
  add_run_flags(*sub, command->run);
  add_section_flags(*sub, command->run.section);
  add_hide_flags(*sub, command->run);
  add_every_flag(*sub, command->run);
  take_list(sub->get_option("--pixel-error"))->default_str("0.25,0.5,1,2,4,8,16,32")->type_name("PX,...");
  sub->add_option("-o,--output", command->output,
                  "Folder for accuracy.json, accuracy.csv, report.html and pictures")
      ->required()
      ->type_name("DIR");
  add_pack_flags(*sub, command->packs);
  take_list(sub->add_option("--strategies", command->strategies,
                            fmt::format("Only these of {}", fmt::join(all_strategies(), ", "))))
      ->check(one_of(all_strategies()))
      ->type_name("NAME,...");
  take_list(sub->add_option("--devices", command->devices, "Measure on each of these: cpu, gl"))
      ->check(one_of({device_name(DeviceKind::cpu), device_name(DeviceKind::gl)}))
      ->excludes("--device")
      ->type_name("NAME,...");
  take_list(sub->add_option("--min-pixels", command->min_pixels,
                            "What approximate strategies may leave out: what owns fewer pixels"))
      ->check(whole_number(1, 1'000'000))
      ->default_str("4,16")
      ->type_name("N,...");
  add_sizes_flag(*sub, command->sizes);
  sub->get_option("--sizes")->excludes("--size");
  add_samples_flag(*sub, command->samples);
  command->compare = sub->add_option("--compare", command->options.compared_frames,
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
  sub->callback([command, sub, &action] {
    check_min_pixels(*sub, command->strategies);
    check_packs(command->packs, command->run.pack);
    action = [command] { return run(*command); };
  });
}

}  // namespace triptych
