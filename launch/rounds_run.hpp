// Commands that play a path several times, in one process.
#pragma once

#include "base/error.hpp"
#include "launch/number_flags.hpp"
#include "launch/run_pipeline.hpp"
#include "measure/json.hpp"
#include "session/open_pack.hpp"

namespace triptych {

struct RoundsCommand {
  RunOptions run;
  CullChoice cull;
  size_t rounds = 5;
};

/// The pack, the path and the pipeline of such a command. Error (path) where there is no frame.
struct RoundsRun {
  explicit RoundsRun(const RoundsCommand& command)
      : pack(open_pack(command.run.pack)),
        frames(load_frames(command.run, pack.skeleton())),
        device(choose_device(command.run.device)),
        pipeline(pack, pipeline_options(command.run, command.cull, device.options)) {
    if (frames.empty()) fail(command.run.path.string(), "there is no frame to measure");
  }

  Pack pack;
  std::vector<FrameRequest> frames;
  ChosenDevice device;
  LocalPipeline pipeline;
};

/// {"rows", "frames", "rounds"} and how it was drawn.
inline void write_rounds(const RoundsCommand& command, const RoundsRun& played, nlohmann::json rows) {
  nlohmann::json report = {
      {"rows", std::move(rows)}, {"frames", played.frames.size()}, {"rounds", command.rounds}};
  add_device(report, played.device.names);
  add_picture(report, command.run);
  write_json(command.run.json, report);
}

/// The flags of such a command, whose run is `run`.
inline void add_rounds_command(CLI::App& app, int (*run)(const RoundsCommand&), Action& action) {
  auto command = std::make_shared<RoundsCommand>();
  add_run_flags(app, command->run);
  add_picture_flags(app, command->run);
  add_cull_flags(app, command->cull);
  app.add_option("--rounds", command->rounds, "How often each is measured; medians are reported")
      ->check(whole_number(1, 1000))
      ->capture_default_str();
  app.callback([command, &app, run, &action] {
    check_cull_flags(app, command->cull);
    action = [command, run] { return run(*command); };
  });
}

}  // namespace triptych
