#include "base/error.hpp"
#include "base/progress.hpp"
#include "base/signals.hpp"
#include "launch/measure.hpp"
#include "launch/number_flags.hpp"
#include "launch/run_program.hpp"
#include "launch/text_table.hpp"
#include "measure/json.hpp"
#include "measure/path_deviation.hpp"
#include "nodes/local_pipeline.hpp"
#include "scene/path.hpp"
#include "session/temporary_folder.hpp"

#include <fmt/core.h>

namespace triptych {

namespace {

struct MeasureSimplifiersCommand {
  BuildFlags flags;
  RunOptions run;
  uint64_t points = 10'000'000;
};

/// The frames of the path for each pixel error.
std::vector<std::vector<FrameRequest>> sweep(const RunOptions& options, const Skeleton& skeleton) {
  std::vector<std::vector<FrameRequest>> paths;
  for (const double pixel_error : options.pixel_errors) {
    RunOptions one = options;
    one.pixel_errors = {pixel_error};
    paths.push_back(load_frames(one, skeleton));
  }
  return paths;
}

std::vector<FrameRecord> draw(LocalPipeline& pipeline, const std::vector<FrameRequest>& path) {
  pipeline.forget();
  std::vector<FrameRecord> records;
  for (const FrameRequest& frame : path) {
    records.push_back(pipeline.draw(frame));
    end_if_asked("measure simplifiers");
  }
  return records;
}

/// Whether the measured deviation keeps the pixel error.
bool kept(const nlohmann::json& row) {
  return row["deviation_px_max"].get<double>() <= row["pixel_error"].get<double>() * 1.001 + 0.01;
}

/// Builds once and adds a row for each pixel error.
void measure(const MeasureSimplifiersCommand& command, const BuildFlags& flags, const DeviceOptions& device,
             const TemporaryFolder& folder, nlohmann::json& rows) {
  const SimplifyLimits limits = flags.options().simplify;
  const std::filesystem::path file =
      folder.path() / (name_of(limits.simplifier) + "-" + name_of(limits.bound) + ".tpk");
  const nlohmann::json build = run_build(flags, file);
  const Pack pack(file);
  const std::vector<std::vector<FrameRequest>> paths = sweep(command.run, pack.skeleton());
  const std::vector<PathDeviation> deviations = measure_deviation(pack, paths, command.points);
  LocalPipeline pipeline(
      pack, {.width = command.run.size.width, .height = command.run.size.height, .device = device});
  Progress progress("draw", paths.size());
  for (size_t i = 0; i < paths.size(); ++i) {
    const std::vector<FrameRecord> frames = draw(pipeline, paths[i]);
    const PathDeviation& deviation = deviations[i];
    const nlohmann::json triangles =
        distribution_json(frames, [](const FrameRecord& r) { return r.drawn_triangles; });
    rows.push_back({{"simplifier", name_of(limits.simplifier)},
                    {"bound", name_of(limits.bound)},
                    {"build_seconds", build["seconds"]},
                    {"pack_bytes", build["pack_bytes"]},
                    {"stuck_groups", build["import"]["stuck_groups"]},
                    {"pixel_error", command.run.pixel_errors[i]},
                    {"drawn_triangles", triangles["mean"]},
                    {"frame_ms", distribution_json(frames, [](const FrameRecord& r) { return r.frame_ms; })},
                    {"deviation_px_max", deviation.pixels_max},
                    {"deviation_drawable", deviation.drawable == no_id ? -1 : int64_t{deviation.drawable}},
                    {"deviation_frame", deviation.frame},
                    {"drawables_in_cuts", deviation.drawables},
                    {"drawables_measured", deviation.drawables_simplified},
                    {"bound_over_measured", to_json(deviation.bound_over_measured)}});
    progress.advance();
  }
  std::error_code ignored;  // removed early, since the disk may be small
  std::filesystem::remove(file, ignored);
}

void print(const nlohmann::json& rows) {
  std::vector<std::vector<std::string>> lines;
  for (const nlohmann::json& row : rows) {
    const auto number = [&](const nlohmann::json& value, int decimals) {
      return in_threes(value.get<double>(), decimals);
    };
    const nlohmann::json& ratio = row["bound_over_measured"];
    lines.push_back({row["simplifier"].get<std::string>(), row["bound"].get<std::string>(),
                     number(row["build_seconds"], 1), number(row["pixel_error"], 1),
                     number(row["drawn_triangles"], 0), number(row["deviation_px_max"], 3),
                     number(ratio["p50"], 2), number(ratio["p95"], 2), number(row["drawables_measured"], 0)});
  }
  fmt::print("{}", text_table({"simplifier", "bound", "build s", "pixel error", "triangles", "measured px",
                               "bound/measured", "p95", "drawables"},
                              lines));
}

int run(const MeasureSimplifiersCommand& command) {
  check_is_no_model_file({command.run.json}, command.flags.inputs);
  load_path(command.run.path);  // so that its errors are reported before anything is built
  std::vector<Simplifier> simplifiers = {Simplifier::collapse, Simplifier::openmesh, Simplifier::meshopt};
  std::vector<Bound> bounds = {Bound::fast, Bound::tight};
  if (command.flags.simplifier) simplifiers = {*command.flags.simplifier};
  if (command.flags.bound) bounds = {*command.flags.bound};
  const ChosenDevice device = choose_device(command.run.device);
  const TemporaryFolder folder;
  nlohmann::json rows = nlohmann::json::array();
  for (const Bound bound : bounds) {
    for (const Simplifier simplifier : simplifiers) {
      BuildFlags flags = command.flags;
      flags.simplifier = simplifier;
      flags.bound = bound;
      measure(command, flags, device.options, folder, rows);
    }
  }
  print(rows);
  const BuildOptions standard;
  nlohmann::json report = {
      {"rows", rows},
      {"default",
       {{"simplifier", name_of(standard.simplify.simplifier)}, {"bound", name_of(standard.simplify.bound)}}},
      {"points", command.points},
      {"size", fmt::format("{}x{}", command.run.size.width, command.run.size.height)}};
  add_device(report, device.names);
  write_json(command.run.json, report);
  for (const nlohmann::json& row : rows) {
    if (kept(row)) continue;
    fail("measure simplifiers", "{}, {}: drawable {} is {} pixels from its source in frame {}, not {}",
         row["simplifier"].get<std::string>(), row["bound"].get<std::string>(),
         row["deviation_drawable"].dump(), row["deviation_px_max"].dump(), row["deviation_frame"].dump(),
         row["pixel_error"].dump());
  }
  return 0;
}

}  // namespace

void add_measure_simplifiers(CLI::App& measure_app, Action& action) {
  auto command = std::make_shared<MeasureSimplifiersCommand>();
  CLI::App* sub = measure_app.add_subcommand(
      "simplifiers", "What accuracy costs: every simplifier and kind of bound, on the same path");
  sub->footer(
      "Example: triptych measure simplifiers scene.gltf --path walk.json --pixel-error 0.5,1,2,4,8\n"
      "--simplifier and --bound restrict it to one of each.");
  add_common_flags(*sub, command->run.json);
  add_build_flags(*sub, command->flags);
  add_device_and_test_flags(*sub, command->run.device);
  add_path_flags(*sub, command->run);
  take_list(sub->get_option("--pixel-error"));
  sub->add_option("--points", command->points,
                  "Points at which distances are measured, over all drawables of a pack")
      ->check(whole_number(1000, uint64_t{1} << 40))
      ->capture_default_str();
  sub->callback([command, &action] { action = [command] { return run(*command); }; });
}

}  // namespace triptych
