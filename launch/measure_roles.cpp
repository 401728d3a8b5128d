#include "base/distribution.hpp"
#include "base/signals.hpp"
#include "launch/measure.hpp"
#include "launch/number_flags.hpp"
#include "launch/recorded_pack.hpp"
#include "launch/text_table.hpp"
#include "measure/json.hpp"
#include "measure/role_times.hpp"
#include "nodes/device_choice.hpp"

#include <fmt/core.h>

namespace triptych {

namespace {

struct MeasureRolesCommand {
  std::filesystem::path folder, pack, json;
  DeviceOptions device{.kind = DeviceKind::automatic};
  StrategyKind strategy = StrategyKind::occlusion;
  size_t rounds = 3;
};

/// A stage of a role, its times over all rounds.
struct RoleStage {
  std::string role, stage;
  std::vector<double> times;
};

void append(std::vector<double>& to, const std::vector<double>& times) {
  to.insert(to.end(), times.begin(), times.end());
}

int run(const MeasureRolesCommand& command) {
  const std::vector<RoleRecording> recordings = read_session_recording(command.folder);
  const RoleRecording& render = recordings.front();
  const Pack pack = open_recorded_pack(render.file, render.header, command.pack);
  const std::vector<FrameRequest> frames = recorded_frames(pack, render);
  const ChosenDevice device = choose_device(command.device);
  std::vector<RoleStage> stages = {{"all in one", "frame", {}}, {role_name(Role::render), "frame", {}}};
  for (const Role role : {Role::switch_0, Role::switch_1}) {
    for (const char* stage : {"hardware cull", "occlusion representation"})
      stages.push_back({role_name(role), stage, {}});
  }
  for (size_t round = 0; round < command.rounds; ++round) {
    append(stages[0].times, time_local_pipeline(pack, frames, device.options, command.strategy));
    append(stages[1].times, time_render_node(pack, render, frames, device.options));
    for (const size_t node : {size_t{0}, size_t{1}}) {
      if (stop_requested()) return interrupted_exit_code();
      const SwitchNodeTimes times =
          time_switch_node(pack, recordings[1 + node], device.options, command.strategy);
      append(stages[2 + 2 * node].times, times.hardware_cull);
      append(stages[3 + 2 * node].times, times.occlusion_representation);
    }
  }
  if (stop_requested()) return interrupted_exit_code();
  const double local = distribution(stages[0].times).p50;
  double slowest = 0;
  nlohmann::json rows = nlohmann::json::array();
  std::vector<std::vector<std::string>> lines;
  for (const RoleStage& stage : stages) {
    if (stage.times.empty()) {  // of a session of one frame
      rows.push_back(
          {{"role", stage.role}, {"stage", stage.stage}, {"ms", nullptr}, {"over_local", nullptr}});
      lines.push_back({stage.role, stage.stage, "-", "-", "-"});
      continue;
    }
    const Distribution times = distribution(stage.times);
    if (&stage != stages.data()) slowest = std::max(slowest, times.p50);
    rows.push_back({{"role", stage.role},
                    {"stage", stage.stage},
                    {"ms", to_json(times)},
                    {"over_local", times.p50 / local}});
    lines.push_back({stage.role, stage.stage, in_threes(times.p50, 2), in_threes(times.p95, 2),
                     in_threes(times.p50 / local, 2)});
  }
  fmt::print("{}the slowest over the local pipeline's frame: {:.2f}\n",
             text_table({"role", "stage", "ms, median", "p95", "over the local frame"}, lines),
             slowest / local);
  nlohmann::json report = {{"rows", rows},
                           {"frames", frames.size()},
                           {"rounds", command.rounds},
                           {"slowest_over_local", slowest / local}};
  add_device(report, device.names);
  write_json(command.json, report);
  return 0;
}

}  // namespace

void add_measure_roles(CLI::App& measure, Action& action) {
  auto command = std::make_shared<MeasureRolesCommand>();
  CLI::App* roles = measure.add_subcommand(
      "roles", "Each role of a recorded session alone, its peers played, beside the frame of one process");
  roles->footer(
      "Example: triptych session scene.tpk --path walk.json --gather 60 --record recording\n"
      "         triptych measure roles recording");
  add_common_flags(*roles, command->json);
  roles->add_option("folder", command->folder, "Folder that `session --record` wrote")
      ->required()
      ->type_name("DIR");
  roles->add_option("--pack", command->pack, "The pack, if it was moved")->type_name("FILE.tpk");
  add_device_flags(*roles, command->device);
  add_exact_cull_flag(*roles, command->strategy);
  roles->get_option("--cull")->description("What the session left out: its own --cull");
  roles->add_option("--rounds", command->rounds, "How often each is measured, in turn")
      ->check(whole_number(1, 1000))
      ->capture_default_str();
  roles->callback([command, &action] { action = [command] { return run(*command); }; });
}

}  // namespace triptych
