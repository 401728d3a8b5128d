#include "base/error.hpp"
#include "launch/measure.hpp"
#include "launch/number_flags.hpp"
#include "launch/run_program.hpp"
#include "launch/text_table.hpp"
#include "measure/hierarchy_quality.hpp"
#include "measure/json.hpp"
#include "measure/side_by_side.hpp"
#include "scene/path.hpp"
#include "session/temporary_folder.hpp"

#include <fmt/core.h>

namespace triptych {

namespace {

struct MeasureHierarchyCommand {
  BuildFlags flags;
  RunOptions run;
  size_t rounds = 3;
};

nlohmann::json row(const std::string& hierarchy, const nlohmann::json& build, const Pack& pack,
                   const SideBySideRun& run) {
  const std::vector<FrameRecord>& frames = run.frames;
  const nlohmann::json tests = distribution_json(frames, [](const FrameRecord& r) { return r.tests; });
  return {
      {"hierarchy", hierarchy},
      {"culling_efficiency", run.comparison.culling_efficiency()},
      {"queries_per_frame", tests["mean"]},
      {"queries", tests},
      {"drawn_triangles", distribution_json(frames, [](const FrameRecord& r) { return r.drawn_triangles; })},
      {"frame_ms", distribution_json(frames, [](const FrameRecord& r) { return r.frame_ms; })},
      {"visible", distribution_json(frames, [](const FrameRecord& r) { return r.visible.size(); })},
      {"cut", distribution_json(frames, [](const FrameRecord& r) { return r.cut_drawables; })},
      {"owning_drawables_mean", static_cast<double>(run.comparison.visible_drawables) /
                                    static_cast<double>(run.comparison.frames_compared)},
      {"identical_frames", run.comparison.identical_frames},
      {"frames_compared", run.comparison.frames_compared},
      {"build_seconds", build["seconds"]},
      {"pack_bytes", build["pack_bytes"]},
      {"drawables", pack.skeleton().drawables.size()},
      {"quality", to_json(hierarchy_quality(pack.skeleton()))}};
}

void print(const nlohmann::json& rows) {
  const auto number = [](const nlohmann::json& value, int decimals = 0) {
    return in_threes(value.get<double>(), decimals);
  };
  std::vector<std::vector<std::string>> lines;
  for (const nlohmann::json& row : rows) {
    lines.push_back({row["hierarchy"].get<std::string>(), number(row["culling_efficiency"], 2),
                     number(row["queries_per_frame"], 1), number(row["visible"]["mean"], 1),
                     number(row["drawn_triangles"]["mean"]), number(row["drawn_triangles"]["p50"]),
                     number(row["frame_ms"]["mean"], 1), number(row["frame_ms"]["p50"], 1),
                     number(row["frame_ms"]["p95"], 1)});
  }
  fmt::print("{}", text_table({"hierarchy", "drawn/visible", "queries", "drawables", "triangles", "median",
                               "frame ms", "median", "p95"},
                              lines));
}

int run(const MeasureHierarchyCommand& command) {
  check_is_no_model_file({command.run.json}, command.flags.inputs);
  load_path(command.run.path);  // so that its errors are reported before anything is built
  const TemporaryFolder folder;
  constexpr std::array kinds = {HierarchyKind::partition_cluster_partition, HierarchyKind::median_split};
  std::vector<nlohmann::json> builds;
  std::vector<std::unique_ptr<Pack>> packs;
  for (const HierarchyKind kind : kinds) {
    BuildFlags flags = command.flags;
    flags.defaults.hierarchy = kind;
    const std::filesystem::path file = folder.path() / (name_of(kind) + ".tpk");
    builds.push_back(run_build(flags, file));
    packs.push_back(std::make_unique<Pack>(file));
  }
  const std::vector<FrameRequest> requests = load_frames(command.run, packs.front()->skeleton());
  const ChosenDevice device = choose_device(command.run.device);
  const std::vector<SideBySideRun> runs = run_side_by_side(
      std::array<const Pack*, 2>{packs[0].get(), packs[1].get()}, requests, device.options, command.rounds);
  nlohmann::json rows = nlohmann::json::array();
  for (size_t i = 0; i < kinds.size(); ++i)
    rows.push_back(row(name_of(kinds[i]), builds[i], *packs[i], runs[i]));
  print(rows);
  fmt::print("{} rounds of {} frames at {} px, frame by frame in turn\n", command.rounds, requests.size(),
             command.run.pixel_error());
  nlohmann::json report = {{"rows", rows},
                           {"frames", requests.size()},
                           {"rounds", command.rounds},
                           {"size", fmt::format("{}x{}", command.run.size.width, command.run.size.height)},
                           {"pixel_error", command.run.pixel_error()}};
  add_device(report, device.names);
  write_json(command.run.json, report);
  for (size_t i = 0; i < kinds.size(); ++i) {
    const Comparison& comparison = runs[i].comparison;
    if (comparison.different.empty()) continue;
    fail("measure hierarchy", "{}: frame {} is not the un-culled picture, and {} frames in all",
         name_of(kinds[i]), comparison.different.front(), comparison.different.size());
  }
  return 0;
}

}  // namespace

void add_measure_hierarchy(CLI::App& measure, Action& action) {
  auto command = std::make_shared<MeasureHierarchyCommand>();
  CLI::App* sub = measure.add_subcommand(
      "hierarchy",
      "Partition-cluster-partition beside a median split of the original objects, on the same path");
  sub->footer("Example: triptych measure hierarchy scene.gltf --path walk.json");
  add_common_flags(*sub, command->run.json);
  add_build_flags(*sub, command->flags);
  add_device_and_test_flags(*sub, command->run.device);
  add_path_flags(*sub, command->run);
  sub->add_option("--rounds", command->rounds, "How often the path is drawn")
      ->check(whole_number(1, 1000))
      ->capture_default_str();
  sub->callback([command, &action] { action = [command] { return run(*command); }; });
}

}  // namespace triptych
