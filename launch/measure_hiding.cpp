#include "base/distribution.hpp"
#include "launch/measure.hpp"
#include "launch/number_flags.hpp"
#include "launch/run_pipeline.hpp"
#include "launch/text_table.hpp"
#include "measure/hiding_cost.hpp"
#include "measure/json.hpp"
#include "session/open_pack.hpp"

#include <fmt/core.h>

namespace triptych {

namespace {

struct MeasureHidingCommand {
  RunOptions run;
  CullChoice cull;
  size_t rounds = 5;
};

int run(const MeasureHidingCommand& command) {
  const Pack pack = open_pack(command.run.pack);
  const std::vector<FrameRequest> frames = load_frames(command.run, pack.skeleton());
  if (frames.empty()) fail(command.run.path.string(), "there is no frame to measure");
  const ChosenDevice device = choose_device(command.run.device);
  LocalPipeline pipeline(pack, pipeline_options(command.run, command.cull, device.options));
  const std::vector<HidingCost> costs = measure_hiding(pack, pipeline, frames, command.rounds);
  const double without = distribution(costs.front().frame.cpu_ms).p50;
  nlohmann::json rows = nlohmann::json::array();
  std::vector<std::vector<std::string>> lines;
  for (const HidingCost& cost : costs) {
    nlohmann::json row = {{"hidden", cost.hidden},
                          {"section", cost.section},
                          {"objects", cost.objects},
                          {"message_bytes", cost.message_bytes},
                          {"frame_over_without", distribution(cost.frame.cpu_ms).p50 / without},
                          {"cold_picture_ms", cost.cold_picture_ms},
                          {"cut", cost.cut},
                          {"drawn_triangles", cost.triangles}};
    std::vector<std::string> line = {cost.section == "none" ? cost.hidden : cost.section,
                                     in_threes(static_cast<double>(cost.objects)),
                                     in_threes(static_cast<double>(cost.message_bytes))};
    for (const auto& [name, times] : {std::pair("apply", &cost.apply),
                                      {"first_picture", &cost.first_picture},
                                      {"same_picture", &cost.same_picture},
                                      {"frame", &cost.frame}}) {
      const Distribution cpu = distribution(times->cpu_ms);
      row[std::string(name) + "_ms"] = to_json(distribution(times->wall_ms));
      row[std::string(name) + "_cpu_ms"] = to_json(cpu);
      line.push_back(in_threes(cpu.p50, 2));
    }
    line.push_back(in_threes(cost.cold_picture_ms, 1));
    line.push_back(in_threes(row["frame_over_without"].get<double>(), 2));
    line.push_back(in_threes(cost.cut));
    line.push_back(in_threes(cost.triangles));
    rows.push_back(std::move(row));
    lines.push_back(std::move(line));
  }
  fmt::print(
      "{}milliseconds are of processor time, medians; those of the clock are in the JSON. cold: the clock's, "
      "of the first picture of all, which reads what was never drawn before\n",
      text_table({"gone", "objects", "bytes", "apply ms", "first picture", "the same shown", "frame ms",
                  "cold ms", "x", "cut", "triangles"},
                 lines));
  nlohmann::json report = {{"rows", rows}, {"frames", frames.size()}, {"rounds", command.rounds}};
  add_device(report, device.names);
  add_picture(report, command.run);
  write_json(command.run.json, report);
  return 0;
}

}  // namespace

void add_measure_hiding(CLI::App& measure, Action& action) {
  auto command = std::make_shared<MeasureHidingCommand>();
  CLI::App* hiding = measure.add_subcommand("hiding",
                                            "What it costs to hide one object, and every second one, and to "
                                            "cut the model: the step, and frames after it");
  hiding->footer("Example: triptych measure hiding scene.tpk --path walk.json --json hiding.json");
  add_run_flags(*hiding, command->run);
  add_picture_flags(*hiding, command->run);
  add_cull_flags(*hiding, command->cull);
  hiding->add_option("--rounds", command->rounds, "How often each is measured; medians are reported")
      ->check(whole_number(1, 1000))
      ->capture_default_str();
  hiding->callback([command, hiding, &action] {
    check_cull_flags(*hiding, command->cull);
    action = [command] { return run(*command); };
  });
}

}  // namespace triptych
