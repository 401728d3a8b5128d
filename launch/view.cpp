#include "base/clock.hpp"
#include "base/memory.hpp"
#include "base/notice.hpp"
#include "base/signals.hpp"
#include "launch/command.hpp"
#include "launch/hide_flags.hpp"
#include "launch/memory_flags.hpp"
#include "launch/number_flags.hpp"
#include "launch/viewpoint_flags.hpp"
#include "measure/json.hpp"
#include "measure/steering_report.hpp"
#include "measure/streaming_report.hpp"
#include "nodes/frame_watch.hpp"
#include "nodes/local_steering.hpp"
#include "session/open_pack.hpp"
#include "session/viewpoint_frames.hpp"
#include "session/window_source.hpp"

#include <fmt/core.h>

namespace triptych {

namespace {

struct ViewCommand {
  RunOptions run;
  ShownModel model;
  CullChoice cull;
  std::optional<ContextKind> context;  ///< nullopt: the display's own
  bool play = false;
  double rate = 0;
  std::filesystem::path pictures = ".";
  FirstViewpoint viewpoint;
};

int run(const ViewCommand& command) {
  stop_requested();  // installs the handlers: from here on a signal closes the window properly
  const Pack pack = open_pack(command.run.pack);
  ViewerOptions options = viewer_options(command.run, pack);
  options.window.context = command.context;
  options.play = command.play;
  options.rate = command.rate;
  options.pictures = command.pictures;
  begin_at_viewpoint(command.viewpoint, pack, options);
  if (options.play && !options.path) fail("view", "--play needs a --path to play");
  Viewer viewer(pack, options);
  say(viewer_help());
  const ChosenDevice device = choose_device(command.run.device, viewer.window().names());
  LocalPipeline pipeline(pack, {.width = viewer.window().width(),
                                .height = viewer.window().height(),
                                .cull = command.cull.kind,
                                .min_pixels = command.cull.min_pixels,
                                .device = device.options,
                                .no_pixel_error = MemoryKeeper::NoPixelError::leaves_out});
  std::optional<LocalSteering> steering = steer(pipeline, command.run.target_ms, device.names);
  std::vector<FrameRecord> records;
  std::vector<double> window_ms;
  FrameWatch watch("view");
  while (!viewer.left()) {
    constexpr double patience_s = 1;
    if (!viewer.wait_for_frame(patience_s)) continue;
    FrameRequest frame = viewer.next_frame();
    if (const FrameTarget& target = pipeline.target();
        target.width() != frame.state.view.width || target.height() != frame.state.view.height) {
      pipeline.resize(frame.state.view.width, frame.state.view.height);
    }
    pipeline.set_strategy(viewer.culling() ? command.cull.kind : StrategyKind::frustum);
    watch.begin(frame.number);
    const FrameRecord record = steering ? steering->draw(frame) : pipeline.draw(frame);
    frame.state.pixel_error = record.pixel_error;
    watch.end();
    const Stopwatch stopwatch;
    viewer.show(frame, record, pipeline.target(), pipeline.device());
    window_ms.push_back(stopwatch.milliseconds());
    // Visible sets are dropped, so that a day at the window does not fill the memory.
    records.push_back(record);
    records.back().visible = {};
  }
  nlohmann::json report = {
      {"frames", records.size()},
      {"frame_ms", distribution_json(records, [](const FrameRecord& r) { return r.frame_ms; })},
      {"window_ms", distribution_json(window_ms, [](double milliseconds) { return milliseconds; })},
      {"drawn_triangles", distribution_json(records, [](const FrameRecord& r) { return r.drawn_triangles; })},
      {"peak_rss_bytes", peak_resident_bytes()}};
  add_device(report, device.names);
  add_picture(report, command.run);
  add_hidden(report, viewer.hiding().name);
  fmt::print("{} frames on {}, median {:.1f} ms\n", records.size(), device_name(device.options.kind),
             report["frame_ms"]["p50"].get<double>());
  if (steering) fmt::print("{}", add_steering(report, records, steering->steering()));
  if (const MemoryCaps& caps = command.run.device.memory; caps.streams())
    fmt::print("{}", add_streaming(report, records, caps, pipeline.memory()));
  write_json(command.run.json, report);
  return interrupted_exit_code();
}

}  // namespace

void add_view(CLI::App& app, Action& action) {
  auto command = std::make_shared<ViewCommand>();
  CLI::App* sub = app.add_subcommand("view", "Walk through a pack in a window, in one process");
  sub->footer("Example: triptych view scene.tpk --path walk.json\nKeys:\n" + viewer_help());
  add_shown_run_flags(*sub, command->run, command->model);
  add_picture_flags(*sub, command->run);
  add_hide_flags(*sub, command->run);
  add_target_flag(*sub, command->run);
  add_memory_flags(*sub, command->run.device.memory);
  sub->get_option("--path")->required(false)->description("A camera path to start from, and to play");
  sub->get_option("--frames")->required(false);
  sub->get_option("--size")->default_str("1280x800");
  sub->get_option("--context")->default_str("the display's own");
  // The window is OpenGL's on both devices: a context may be named beside --device cpu.
  sub->parse_complete_callback([command, sub] { resolve_device(*sub, command->run.device); });
  add_cull_flags(*sub, command->cull);
  sub->add_option("--rate", command->rate,
                  "Cameras of the path a second, while it plays (default: as fast as pictures come)")
      ->check(number_between(0.01, 1000.0));
  sub->add_flag("--play", command->play, "Play the path at once, over and over");
  sub->add_option("-o,--output", command->pictures, "Folder for what F2 to F5 save")
      ->type_name("DIR")
      ->capture_default_str();
  add_viewpoint_flags(*sub, command->viewpoint);
  sub->callback([command, sub, &action] {
    check_cull_flags(*sub, command->cull);
    check_target_flag(command->run, command->cull.kind);
    size_for_window(*sub, command->run);
    check_shown_model(*sub, command->model);
    if (sub->count("--context") > 0) command->context = command->run.device.context;
    action = [command] {
      command->run.pack = pack_of(command->model, {command->run.json});
      return run(*command);
    };
  });
}

}  // namespace triptych
