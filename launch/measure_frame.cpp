#include "launch/hide_flags.hpp"
#include "launch/measure.hpp"
#include "launch/number_flags.hpp"
#include "launch/pick_steps.hpp"
#include "launch/text_table.hpp"
#include "measure/allocation_count.hpp"
#include "measure/frame_steps.hpp"
#include "measure/json.hpp"
#include "nodes/pack_device.hpp"
#include "session/open_pack.hpp"

#include <fmt/core.h>

namespace triptych {

namespace {

struct MeasureFrameCommand {
  RunOptions run;
  size_t rounds = 5;
};

/// Whether the step is part of a frame; the reference selection is not.
bool of_frame(size_t step) { return step != static_cast<size_t>(FrameStep::select_cut); }
/// Whether the step codes messages, which allocates the bytes that it passes on.
bool of_message(size_t step) {
  return step == static_cast<size_t>(FrameStep::encode_delta) ||
         step == static_cast<size_t>(FrameStep::receive_delta);
}

nlohmann::json row(const std::string& name, const std::vector<double>& microseconds, double allocations) {
  return {{"step", name},
          {"us", to_json(distribution(microseconds))},
          {"allocations", allocations_are_counted() ? nlohmann::json(allocations) : nlohmann::json()}};
}

nlohmann::json report_of(const std::vector<FrameStepSamples>& samples) {
  nlohmann::json rows = nlohmann::json::array();
  const double frames = std::max<double>(static_cast<double>(samples.size()), 1);
  std::vector<double> whole(samples.size(), 0);
  double all = 0, of_loop = 0;
  for (size_t step = 0; step < frame_step_names.size(); ++step) {
    std::vector<double> microseconds;
    double allocations = 0;
    for (size_t frame = 0; frame < samples.size(); ++frame) {
      const FrameStepSample& sample = samples[frame][step];
      microseconds.push_back(sample.microseconds);
      allocations += static_cast<double>(sample.allocations) / frames;
      if (of_frame(step)) whole[frame] += sample.microseconds;
    }
    rows.push_back(row(frame_step_names[step], microseconds, allocations));
    if (of_frame(step)) all += allocations;
    if (of_frame(step) && !of_message(step)) of_loop += allocations;
  }
  rows.push_back(row("frame", whole, all));
  return {{"rows", rows},
          {"frames", samples.size()},
          {"allocations_per_frame", allocations_are_counted() ? nlohmann::json(of_loop) : nlohmann::json()}};
}

/// What is done when a person clicks or measures, which is no part of a frame.
void add_picks(const std::vector<PickSamples>& samples, nlohmann::json& rows) {
  for (size_t step = 0; step < pick_step_names.size(); ++step) {
    std::vector<double> microseconds;
    for (const PickSamples& frame : samples) microseconds.push_back(frame[step]);
    rows.push_back({{"step", pick_step_names[step]},
                    {"us", to_json(distribution(microseconds))},
                    {"allocations", nullptr}});
  }
}

int run(const MeasureFrameCommand& command) {
  const Pack pack = open_pack(command.run.pack);
  const std::vector<FrameRequest> frames = load_frames(command.run, pack);
  const ChosenDevice chosen = choose_device(command.run.device);
  PackDevice device(pack, chosen.options);
  nlohmann::json report =
      report_of(measure_frame_steps(pack, device.hierarchy(), device.device(), frames, command.rounds));
  add_picks(measure_picks(pack, frames, chosen.options), report["rows"]);
  std::vector<std::vector<std::string>> lines;
  for (const nlohmann::json& line : std::as_const(report)["rows"]) {
    const nlohmann::json& us = line["us"];
    lines.push_back({line["step"].get<std::string>(), in_threes(us["mean"].get<double>(), 1),
                     in_threes(us["p50"].get<double>(), 1), in_threes(us["p95"].get<double>(), 1),
                     line["allocations"].is_null() ? "-" : in_threes(line["allocations"].get<double>(), 1)});
  }
  fmt::print("{}", text_table({"step", "us", "median", "p95", "allocations"}, lines));
  add_device(report, chosen.names);
  add_picture(report, command.run);
  add_hidden(report, frames.empty() ? HiddenName() : frames.front().state.hiding.name);
  write_json(command.run.json, report);
  return 0;
}

}  // namespace

void add_measure_frame(CLI::App& measure, Action& action) {
  auto command = std::make_shared<MeasureFrameCommand>();
  CLI::App* frame = measure.add_subcommand(
      "frame", "The steps of a frame without drawing: microseconds and allocations of each");
  frame->footer("Example: triptych measure frame scene.tpk --path walk.json --json frame.json");
  add_run_flags(*frame, command->run);
  add_picture_flags(*frame, command->run);
  add_hide_flags(*frame, command->run);
  frame->add_option("--rounds", command->rounds, "How often the path is played; the medians are reported")
      ->check(whole_number(1, 1000))
      ->capture_default_str();
  frame->callback([command, &action] { action = [command] { return run(*command); }; });
}

}  // namespace triptych
