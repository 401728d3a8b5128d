#include "base/distribution.hpp"
#include "launch/measure.hpp"
#include "launch/rounds_run.hpp"
#include "launch/text_table.hpp"
#include "measure/hiding_cost.hpp"

#include <fmt/core.h>

namespace triptych {

namespace {

int run(const RoundsCommand& command) {
  RoundsRun played(command);
  const std::vector<HidingCost> costs =
      measure_hiding(played.pack, played.pipeline, played.frames, command.rounds);
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
  write_rounds(command, played, std::move(rows));
  return 0;
}

}  // namespace

void add_measure_hiding(CLI::App& measure, Action& action) {
  CLI::App* hiding = measure.add_subcommand("hiding",
                                            "What it costs to hide one object, and every second one, and to "
                                            "cut the model: the step, and frames after it");
  hiding->footer("Example: triptych measure hiding scene.tpk --path walk.json --json hiding.json");
  add_rounds_command(*hiding, run, action);
}

}  // namespace triptych
