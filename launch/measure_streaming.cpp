#include "base/clock.hpp"
#include "base/memory.hpp"
#include "base/progress.hpp"
#include "launch/command.hpp"
#include "launch/hide_flags.hpp"
#include "launch/measure.hpp"
#include "launch/memory_flags.hpp"
#include "launch/number_flags.hpp"
#include "launch/run_pipeline.hpp"
#include "measure/json.hpp"
#include "measure/streaming_report.hpp"
#include "nodes/frame_watch.hpp"
#include "session/open_pack.hpp"

#include <chrono>
#include <fmt/core.h>
#include <thread>

namespace triptych {

namespace {

struct MeasureStreamingCommand {
  RunOptions run;
  CullChoice cull;
  size_t rounds = 1;
  double rate = 0;
};

int run(const MeasureStreamingCommand& command) {
  const Pack pack = open_pack(command.run.pack);
  const std::vector<FrameRequest> frames = load_frames(command.run, pack);
  const ChosenDevice device = choose_device(command.run.device);
  LocalPipeline pipeline(pack, pipeline_options(command.run, command.cull, device.options));
  std::vector<FrameRecord> records;
  {
    Progress progress("measure streaming", frames.size() * command.rounds);
    FrameWatch watch("measure streaming");
    const Stopwatch clock;
    for (size_t round = 0; round < command.rounds; ++round) {
      for (const FrameRequest& frame : frames) {
        if (command.rate > 0) {
          const double due_s = static_cast<double>(records.size()) / command.rate - clock.seconds();
          if (due_s > 0) std::this_thread::sleep_for(std::chrono::duration<double>(due_s));
        }
        watch.begin(frame.number);
        records.push_back(pipeline.draw(frame));
        records.back().visible = {};
        watch.end();
        progress.advance();
      }
    }
  }
  const auto of_frames = [&](auto value) { return distribution_json(records, value); };
  nlohmann::json report = {
      {"frames", records.size()},
      {"rounds", command.rounds},
      {"pack_bytes", pack.size()},
      {"frame_ms", of_frames([](const FrameRecord& r) { return r.frame_ms; })},
      {"pixel_error", of_frames([](const FrameRecord& r) { return r.pixel_error; })},
      {"drawn_triangles", of_frames([](const FrameRecord& r) { return r.drawn_triangles; })}};
  const std::string words = add_streaming(report, records, command.run.device.memory, pipeline.memory());
  report["peak_rss_bytes"] = peak_resident_bytes();
  add_device(report, device.names);
  add_picture(report, command.run);
  fmt::print(
      "{} frames on {}: {:.1f} ms, 95th percentile {:.1f}, 99th {:.1f}, the longest {:.1f}\n{}"
      "the process took {:.1f} MiB at most\n",
      records.size(), device_name(device.options.kind), report["frame_ms"]["p50"].get<double>(),
      report["frame_ms"]["p95"].get<double>(), report["frame_ms"]["p99"].get<double>(),
      report["frame_ms"]["max"].get<double>(), words, static_cast<double>(peak_resident_bytes()) / 0x1p20);
  write_json(command.run.json, report);
  return 0;
}

}  // namespace

void add_measure_streaming(CLI::App& measure, Action& action) {
  auto command = std::make_shared<MeasureStreamingCommand>();
  CLI::App* sub = measure.add_subcommand(
      "streaming",
      "A path within caps of memory: what is read, evicted and waited for, and what frames take");
  sub->footer(
      "Example: triptych measure streaming scene.tpk --path walk.json --memory 384M --device-memory 128M");
  add_run_flags(*sub, command->run);
  add_picture_flags(*sub, command->run);
  add_hide_flags(*sub, command->run);
  add_cull_flags(*sub, command->cull);
  add_memory_flags(*sub, command->run.device.memory);
  sub->add_option("--rounds", command->rounds,
                  "How often the path is played: what is left of it the next time shows")
      ->check(whole_number(1, 1000))
      ->capture_default_str();
  sub->add_option("--rate", command->rate,
                  "Frames a second, so that there is time to read ahead (default: as fast as they come)")
      ->check(number_between(min_rate, max_rate));
  sub->callback([command, sub, &action] {
    check_cull_flags(*sub, command->cull);
    action = [command] { return run(*command); };
  });
}

}  // namespace triptych
