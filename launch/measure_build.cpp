#include "base/error.hpp"
#include "launch/import_flags.hpp"
#include "launch/measure.hpp"
#include "launch/run_program.hpp"
#include "launch/text_table.hpp"
#include "measure/json.hpp"
#include "measure/yardstick.hpp"
#include "session/temporary_folder.hpp"

#include <fmt/core.h>

namespace triptych {

namespace {

struct MeasureBuildCommand {
  BuildFlags flags;
  std::filesystem::path keep, json;
};

std::vector<std::string> yardstick_arguments(const BuildFlags& flags) {
  std::vector<std::string> arguments = {"measure", "yardstick"};
  for (const auto& input : flags.inputs) arguments.push_back(std::filesystem::absolute(input).string());
  for (const std::string& argument : import_arguments(flags.import)) arguments.push_back(argument);
  return arguments;
}

void print(const nlohmann::json& report) {
  const auto figure = [&](const char* key) { return report[key].get<double>(); };
  std::vector<std::vector<std::string>> rows;
  for (const nlohmann::json& stage : report["stages"])
    rows.push_back({stage["name"].get<std::string>(), in_threes(stage["seconds"].get<double>(), 1)});
  fmt::print("{}", text_table({"stage", "seconds"}, rows));
  const double yardstick = figure("yardstick_triangles_per_second");
  fmt::print("{} triangles in {:.1f} s: {} per second, {:.2f} times meshopt_simplify's {} on one core\n",
             in_threes(figure("stored_source_triangles")), figure("seconds"),
             in_threes(figure("triangles_per_second")),
             yardstick > 0 ? figure("triangles_per_second") / yardstick : 0, in_threes(yardstick));
  fmt::print("peak {} MiB, pack {} bytes, {:.1f} bytes per source triangle as stored\n",
             in_threes(figure("peak_rss_bytes") / (1 << 20)), in_threes(figure("pack_bytes")),
             figure("bytes_per_triangle"));
}

int run(const MeasureBuildCommand& command) {
  check_is_no_model_file({command.keep, command.json}, command.flags.inputs);
  if (!command.keep.empty()) check_may_become_pack(command.keep);
  // Beside the pack to keep, so that it can be renamed; under a new name, so that no earlier build is
  // resumed.
  const TemporaryFolder folder(command.keep.empty() ? std::filesystem::path()
                                                    : std::filesystem::absolute(command.keep).parent_path());
  const std::filesystem::path pack = folder.path() / "measured.tpk";
  nlohmann::json report = run_build(command.flags, pack);
  if (!command.keep.empty()) {
    std::error_code error;
    std::filesystem::rename(pack, command.keep, error);
    if (error) fail(command.keep.string(), "cannot be written: {}", error.message());
  }
  const nlohmann::json yardstick =
      run_program("yardstick", yardstick_arguments(command.flags), folder.path());
  // Triangles in the pack: each mesh once, or each placement if meshes are not shared.
  const double stored =
      report[command.flags.bake_instances ? "placed_triangles" : "source_triangles"].get<double>();
  report["stored_source_triangles"] = static_cast<uint64_t>(stored);
  report["triangles_per_second"] = stored / report["seconds"].get<double>();
  report["bytes_per_triangle"] = report["pack_bytes"].get<double>() / stored;
  report["yardstick_triangles_per_second"] = yardstick["triangles_per_second"];
  report["yardstick"] = yardstick;
  const BuildOptions options = command.flags.options();
  report["simplifier"] = name_of(options.simplify.simplifier);
  report["bound"] = name_of(options.simplify.bound);
  print(report);
  write_json(command.json, report);
  return 0;
}

constexpr double min_yardstick_seconds = 1;
constexpr size_t max_yardstick_passes = 20;

struct YardstickCommand {
  std::vector<std::filesystem::path> inputs;
  ImportOptions import;
  std::filesystem::path json;
};

int run(const YardstickCommand& command) {
  check_is_no_model_file({command.json}, command.inputs);
  const Model model = import_model(command.inputs, command.import);
  Yardstick yardstick;
  size_t passes = 0;
  // A small model takes so little time that other load on the machine dominates: so it is repeated.
  while (passes == 0 || (yardstick.seconds < min_yardstick_seconds && passes < max_yardstick_passes)) {
    const Yardstick pass = measure_yardstick(model);
    yardstick.triangles += pass.triangles;
    yardstick.left += pass.left;
    yardstick.seconds += pass.seconds;
    ++passes;
  }
  yardstick.triangles /= passes;
  yardstick.left /= passes;
  yardstick.seconds /= static_cast<double>(passes);
  fmt::print("meshopt_simplify alone: {} triangles to {} in {:.2f} s, {} per second\n",
             in_threes(static_cast<double>(yardstick.triangles)),
             in_threes(static_cast<double>(yardstick.left)), yardstick.seconds,
             in_threes(yardstick.triangles_per_second()));
  write_json(command.json, {{"triangles", yardstick.triangles},
                            {"triangles_left", yardstick.left},
                            {"passes", passes},
                            {"seconds", yardstick.seconds},
                            {"triangles_per_second", yardstick.triangles_per_second()}});
  return 0;
}

}  // namespace

void add_measure_build(CLI::App& measure, Action& action) {
  auto command = std::make_shared<MeasureBuildCommand>();
  CLI::App* sub =
      measure.add_subcommand("build", "A build in a process of its own: its rate, memory, bytes and stages");
  sub->footer("Example: triptych measure build scene.gltf --bound fast --json build.json");
  add_common_flags(*sub, command->json);
  add_build_flags(*sub, command->flags);
  sub->add_option("--keep-pack", command->keep, "Keep the pack")->type_name("FILE.tpk");
  sub->callback([command, &action] { action = [command] { return run(*command); }; });
}

void add_measure_yardstick(CLI::App& measure, Action& action) {
  auto command = std::make_shared<YardstickCommand>();
  CLI::App* sub = measure.add_subcommand(
      "yardstick", "How fast meshopt_simplify alone halves the same geometry on one core");
  sub->footer("Example: triptych measure yardstick scene.gltf");
  add_common_flags(*sub, command->json);
  sub->add_option("input", command->inputs, "Model files")->required()->type_name("INPUT");
  add_import_flags(*sub, command->import);
  sub->callback([command, &action] { action = [command] { return run(*command); }; });
}

}  // namespace triptych
