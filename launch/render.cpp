#include "base/memory.hpp"
#include "base/progress.hpp"
#include "base/timeline.hpp"
#include "launch/command.hpp"
#include "launch/hide_flags.hpp"
#include "launch/memory_flags.hpp"
#include "launch/number_flags.hpp"
#include "launch/output_folder.hpp"
#include "lod/sectioned.hpp"
#include "measure/effects_drawn.hpp"
#include "measure/frame_series.hpp"
#include "measure/json.hpp"
#include "measure/steering_report.hpp"
#include "measure/streaming_report.hpp"
#include "measure/timeline_trace.hpp"
#include "nodes/frame_watch.hpp"
#include "nodes/local_steering.hpp"
#include "render/png_file.hpp"
#include "session/open_pack.hpp"
#include "session/pictures.hpp"
#include "session/viewpoint_frames.hpp"

#include <fmt/core.h>

namespace triptych {

namespace {

struct RenderCommand {
  RunOptions run;
  ShownModel model;
  std::filesystem::path output, timeline, bcf;
  CullChoice cull;
  const CLI::App* words = nullptr;  ///< what was parsed
  bool full_detail = false, item_buffer = false;
};

int run(const RenderCommand& command) {
  if (!command.timeline.empty()) start_timeline();
  const Pack pack = open_pack(command.run.pack);
  std::vector<FrameRequest> frames =
      command.bcf.empty() ? load_frames(command.run, pack) : viewpoint_frames(command.bcf, command.run, pack);
  const ChosenDevice device = choose_device(command.run.device);
  OutputFolder claimed(command.output, run_line(*command.words));
  const auto [width, height] = command.run.size;
  LocalPipeline pipeline(pack, {.width = width,
                                .height = height,
                                .cull = command.cull.kind,
                                .min_pixels = command.cull.min_pixels,
                                .device = device.options,
                                .item_buffer = command.item_buffer});
  std::optional<LocalSteering> steering = steer(pipeline, command.run.target_ms, device.names);
  std::vector<FrameRecord> records;
  std::vector<SectionedCounts> sectioned;  ///< of each frame
  {
    Progress progress("render", frames.size());
    FrameWatch watch("render");
    for (FrameRequest& frame : frames) {
      watch.begin(frame.number);
      if (command.full_detail) frame.state.pixel_error = 0;
      records.push_back(steering ? steering->draw(frame) : pipeline.draw(frame));
      frame.state.pixel_error = records.back().pixel_error;
      sectioned.push_back(count_sectioned(pipeline.hierarchy(), FrameView(pack.skeleton(), frame.state),
                                          records.back().visible));
      const FrameTarget& target = pipeline.target();
      write_png(command.output / picture_name(frame.number), width, height,
                command.item_buffer ? item_colors(target.read_items()) : target.read_colors());
      watch.end();
      progress.advance();
    }
  }
  claimed.finish();
  nlohmann::json report = {
      {"frames", records.size()},
      {"frame_ms", distribution_json(records, [](const FrameRecord& r) { return r.frame_ms; })},
      {"occlusion_representation_ms",
       distribution_json(records, [](const FrameRecord& r) { return r.occlusion_representation_ms; })},
      {"hardware_cull_ms",
       distribution_json(records, [](const FrameRecord& r) { return r.hardware_cull_ms; })},
      {"render_ms", distribution_json(records, [](const FrameRecord& r) { return r.render_ms; })},
      {"drawn_triangles", distribution_json(records, [](const FrameRecord& r) { return r.drawn_triangles; })},
      {"visible", distribution_json(records, [](const FrameRecord& r) { return r.visible.size(); })},
      {"cut", distribution_json(records, [](const FrameRecord& r) { return r.cut_drawables; })},
      {"sectioned", distribution_json(sectioned, [](const SectionedCounts& c) { return c.placements; })},
      {"sectioned_open", distribution_json(sectioned, [](const SectionedCounts& c) { return c.open; })},
      {"tests", distribution_json(records, [](const FrameRecord& r) { return r.tests; })},
      {"effects_drawn", effects_drawn(records)},
      {"series", frame_series(records)},
      {"peak_rss_bytes", peak_resident_bytes()}};
  if (command.run.device.memory.streams()) {
    nlohmann::json& errors = report["series"]["pixel_error"];
    for (const FrameRecord& record : records) errors.push_back(record.pixel_error);
  }
  add_device(report, device.names);
  add_picture(report, command.run);
  add_hidden(report, frames.empty() ? HiddenName() : frames.front().state.hiding.name);
  fmt::print(
      "{} frames on {}, median {:.1f} ms, {:.0f} drawables and {:.0f} triangles drawn of a cut of {:.0f}\n",
      records.size(), device_name(device.options.kind), report["frame_ms"]["p50"].get<double>(),
      report["visible"]["mean"].get<double>(), report["drawn_triangles"]["mean"].get<double>(),
      report["cut"]["mean"].get<double>());
  if (const auto open = report["sectioned_open"]["mean"].get<double>(); open > 0) {
    fmt::print(
        "the section cuts {:.0f} placed parts a frame, of which {:.0f} are open and show their insides\n",
        report["sectioned"]["mean"].get<double>(), open);
  }
  if (steering) fmt::print("{}", add_steering(report, records, steering->steering()));
  if (const MemoryCaps& caps = command.run.device.memory; caps.streams())
    fmt::print("{}", add_streaming(report, records, caps, pipeline.memory()));
  write_json(command.run.json, report);
  if (!command.timeline.empty()) write_json(command.timeline, chrome_trace({own_timeline("render")}, {}));
  return 0;
}

}  // namespace

void add_render(CLI::App& app, Action& action) {
  auto command = std::make_shared<RenderCommand>();
  CLI::App* sub = app.add_subcommand("render", "Draw a path in one process, without a display");
  command->words = sub;
  sub->footer("Example: triptych render scene.tpk --path walk.json -o pictures");
  add_shown_run_flags(*sub, command->run, command->model);
  add_picture_flags(*sub, command->run);
  add_hide_flags(*sub, command->run);
  add_target_flag(*sub, command->run);
  add_memory_flags(*sub, command->run.device.memory);
  sub->add_option("-o,--output", command->output, "Folder for the PNG files")->required()->type_name("DIR");
  add_cull_flags(*sub, command->cull);
  add_timeline_flag(*sub, command->timeline);
  sub->add_flag("--full-detail", command->full_detail, "Draw the finest level of everything")
      ->excludes("--target-ms");
  sub->add_flag("--item-buffer", command->item_buffer, "Draw each drawable in a colour of its own");
  add_every_flag(*sub, command->run);
  sub->get_option("--path")->required(false);
  sub->add_option("--bcf", command->bcf, "Draw the viewpoints of this BCF file instead of a path")
      ->type_name("FILE")
      ->excludes("--path");
  sub->callback([command, sub, &action] {
    check_cull_flags(*sub, command->cull);
    check_target_flag(command->run, command->cull.kind);
    require_path(command->run, !command->bcf.empty());
    check_shown_model(*sub, command->model);
    action = [command] {
      command->run.pack = pack_of(command->model, {command->run.json, command->timeline});
      return run(*command);
    };
  });
}

}  // namespace triptych
