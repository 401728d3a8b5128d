#include "launch/measure.hpp"
#include "launch/number_flags.hpp"
#include "measure/json.hpp"
#include "measure/prediction_trial.hpp"
#include "measure/steering_report.hpp"
#include "session/open_pack.hpp"

#include <fmt/core.h>

namespace triptych {

namespace {

struct MeasureTargetCommand {
  RunOptions run;
  size_t repetitions = 5;
};

int run(const MeasureTargetCommand& command) {
  const Pack pack = open_pack(command.run.pack);
  std::vector<FrameRequest> frames = load_frames(command.run, pack.skeleton());
  const ChosenDevice device = choose_device(command.run.device);
  const auto [width, height] = command.run.size;
  LocalPipeline pipeline(pack, {.width = width, .height = height, .device = device.options});
  FrameSteering steering(
      pack.skeleton(),
      {.target_ms = command.run.target_ms, .measure = measure_of(device.names), .rules = pipeline.rules()});
  nlohmann::json report = {{"target_ms", command.run.target_ms},
                           {"cost", measure_name(steering.options().measure)},
                           {"repetitions", command.repetitions}};
  const std::string summary =
      add_predictions(report, try_predictions(pipeline, steering, frames, command.repetitions));
  report["coefficients_ms"] = coefficients_json(steering.model().coefficients());
  add_device(report, device.names);
  add_picture(report, command.run);
  fmt::print("{}", summary);
  write_json(command.run.json, report);
  return 0;
}

}  // namespace

void add_measure_target(CLI::App& measure, Action& action) {
  auto command = std::make_shared<MeasureTargetCommand>();
  CLI::App* target = measure.add_subcommand(
      "target", "How well --target-ms predicts what frames cost, and how well that could be predicted");
  target->footer("Example: triptych measure target scene.tpk --path walk.json --target-ms 5");
  add_run_flags(*target, command->run);
  add_picture_flags(*target, command->run);
  add_target_flag(*target, command->run)->required();
  target
      ->add_option("--repetitions", command->repetitions,
                   "How often each frame is drawn again: the median is what it costs")
      ->check(whole_number(2, 1000))
      ->capture_default_str();
  add_every_flag(*target, command->run);
  target->callback([command, &action] { action = [command] { return run(*command); }; });
}

}  // namespace triptych
