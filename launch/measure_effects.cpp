#include "launch/measure.hpp"
#include "launch/rounds_run.hpp"
#include "launch/text_table.hpp"
#include "measure/effects_cost.hpp"

#include <fmt/core.h>

namespace triptych {

namespace {

int run(const RoundsCommand& command) {
  RoundsRun played(command);
  std::vector<Effect> effects;
  for (const Effect effect : called_for(played.pack.skeleton())) {
    if (command.run.effects.has(effect)) effects.push_back(effect);
  }
  const std::vector<EffectsCost> costs =
      measure_effects(played.pipeline, played.frames, effects, command.rounds);
  const double without = distribution(costs.front().cpu_ms).p50;
  const auto count = static_cast<double>(played.frames.size());
  nlohmann::json rows = nlohmann::json::array();
  std::vector<std::vector<std::string>> lines;
  for (const EffectsCost& cost : costs) {
    const std::string name(cost.added ? effect_name(*cost.added) : "none");
    const Distribution cpu = distribution(cost.cpu_ms);
    const auto a_frame = [&](auto sum) { return static_cast<double>(sum) / count; };
    rows.push_back({{"effect", name},
                    {"frame_ms", to_json(distribution(cost.wall_ms))},
                    {"frame_cpu_ms", to_json(cpu)},
                    {"frame_over_none", cpu.p50 / without},
                    {"frames", cost.used_frames},
                    {"effect_ms", a_frame(cost.use.ms)},
                    {"draws", a_frame(cost.use.draws)},
                    {"binds", a_frame(cost.use.binds)},
                    {"upload_bytes", a_frame(cost.use.upload_bytes)},
                    {"fragments", a_frame(cost.use.fragments)},
                    {"splits", cost.use.splits},
                    {"variants", cost.use.variants},
                    {"simulation_steps", a_frame(cost.use.simulation_steps)},
                    {"drawn_triangles", cost.triangles}});
    lines.push_back({name, in_threes(cpu.p50, 2), in_threes(cpu.p50 / without, 2),
                     in_threes(static_cast<double>(cost.used_frames)), in_threes(a_frame(cost.use.ms), 2),
                     in_threes(a_frame(cost.use.draws), 1), in_threes(a_frame(cost.use.binds), 1),
                     in_threes(a_frame(cost.use.upload_bytes)), in_threes(a_frame(cost.use.fragments)),
                     in_threes(a_frame(cost.use.simulation_steps), 1),
                     in_threes(static_cast<double>(cost.use.variants)), in_threes(cost.triangles)});
  }
  fmt::print(
      "each row has one effect more than the row before; times are of processors, medians; counts a frame, "
      "of "
      "the effect\n{}",
      text_table({"added", "frame ms", "x", "frames", "effect ms", "draws", "binds", "bytes", "fragments",
                  "steps", "variants", "triangles"},
                 lines));
  write_rounds(command, played, std::move(rows));
  return 0;
}

}  // namespace

void add_measure_effects(CLI::App& measure, Action& action) {
  CLI::App* effects = measure.add_subcommand(
      "effects", "What each effect that the model calls for costs, added one after the other");
  effects->footer("Example: triptych measure effects scene.tpk --path walk.json --json effects.json");
  add_rounds_command(*effects, run, action);
}

}  // namespace triptych
