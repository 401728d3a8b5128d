#include "nodes/replay.hpp"

#include "base/hashing.hpp"
#include "base/notice.hpp"
#include "launch/choice_flag.hpp"
#include "launch/command.hpp"
#include "launch/named_files.hpp"
#include "launch/number_flags.hpp"
#include "launch/output_folder.hpp"
#include "launch/recorded_pack.hpp"
#include "launch/section_flags.hpp"
#include "measure/json.hpp"
#include "nodes/injected_rules.hpp"
#include "nodes/pack_device.hpp"
#include "nodes/picture_stage.hpp"
#include "render/png_file.hpp"
#include "scene/pack.hpp"
#include "session/pictures.hpp"

#include <fmt/core.h>
#include <set>

namespace triptych {

namespace {

struct ReplayCommand {
  std::filesystem::path folder, pack, output, json;
  DeviceOptions device{.kind = DeviceKind::automatic};
  std::optional<uint32_t> frame;  ///< nullopt: all of them
  bool partial = false;
  const CLI::App* words = nullptr;  ///< what was parsed
};

/// Draws replayed frames; keeps state from one to the next.
class Replayer {
 public:
  Replayer(const ReplayCommand& command, const Pack& pack, const DeviceOptions& device)
      : command_(command), pack_(pack), device_(pack, device) {}

  /// Whether to draw the frame; one that a killed render node drew and its successor drew again is drawn
  /// once.
  bool wants(uint32_t frame) const {
    return (!command_.frame || *command_.frame == frame) && drawn_.count(frame) == 0;
  }
  bool done() const { return command_.frame && !frames_.empty(); }

  void draw(const ReplayedFrame& frame) {
    const View& view = frame.request.state.view;
    if (!picture_ || picture_->target().width() != view.width || picture_->target().height() != view.height) {
      picture_.emplace(device_.device(), view.width, view.height);
    }
    std::vector<DrawableId> ordered = frame.visible;
    const FrameView frame_view(pack_.skeleton(), frame.request.state, injected_frame_rules());
    sort_by_rank(frame_view, ordered);
    picture_->begin(frame_view);
    picture_->draw(ordered);
    const std::vector<uint8_t> colors = picture_->target().read_colors();
    const uint64_t hash = hash_values(std::span<const uint8_t>(colors));
    write_png(command_.frame ? command_.output : command_.output / picture_name(frame.request.number),
              view.width, view.height, colors);
    drawn_.insert(frame.request.number);
    frames_.push_back({{"number", frame.request.number},
                       {"pixel_error", frame.request.state.pixel_error},
                       {"samples", frame.request.state.samples},
                       {"edges", frame.request.state.edges},
                       {"time", frame.request.state.time},
                       {"hidden", frame.request.state.hiding.name.count},
                       {"section", section_json(frame.request.state.section)},
                       {"visible", frame.visible.size()},
                       {"drawn_triangles", picture_->drawn_triangles()},
                       {"digest_mismatch", frame.digest_mismatch},
                       {"alone", frame.fallback},
                       {"picture_hash", fmt::format("{:016x}", hash)}});
  }
  const nlohmann::json& frames() const { return frames_; }

 private:
  const ReplayCommand& command_;
  const Pack& pack_;
  PackDevice device_;
  std::optional<PictureStage> picture_;
  std::set<uint32_t> drawn_;
  nlohmann::json frames_ = nlohmann::json::array();
};

/// Plays one file of the render node; returns where it was cut, if it was and that is allowed.
std::string play(const ReplayCommand& command, const Pack& pack, RecordingReader& reader,
                 const std::filesystem::path& file, Replayer& replayer) {
  Replay replay(pack, file.string());
  try {
    while (const auto recorded = reader.next()) {
      if (replayer.done()) continue;  // the rest is read nevertheless, to find damage
      for (const ReplayedFrame& frame : replay.take(*recorded)) {
        if (replayer.wants(frame.request.number)) replayer.draw(frame);
      }
    }
  } catch (const RecordingCut& cut) {
    if (!command.partial) throw Error(cut.what(), "--partial shows what it holds");
    return cut.what();
  }
  return {};
}

int run(const ReplayCommand& command) {
  const auto files = recordings_of(Role::render, command.folder);
  if (files.empty()) fail(command.folder.string(), "holds no recording of a render node");
  const RecordingHeader header = RecordingReader(files.front()).header();
  const Pack pack = open_recorded_pack(files.front(), header, command.pack);
  for (const std::filesystem::path& output : {command.output, command.json}) {
    for (const Role role : all_roles)
      check_is_none_of(output, recordings_of(role, command.folder), "a part of the recording");
    check_is_none_of(output, {header.pack}, "the pack of the recording");
  }
  std::optional<OutputFolder> claimed;
  if (!command.frame) claimed.emplace(command.output, run_line(*command.words));
  const ChosenDevice device = choose_device(command.device);
  if (device.names.renderer != header.own.device.renderer ||
      device.names.version != header.own.device.version) {
    notice("replay: recorded with {} {}, drawn with {} {}: pixels may differ", header.own.device.renderer,
           header.own.device.version, device.names.renderer, device.names.version);
  }
  Replayer replayer(command, pack, device.options);
  std::string cut;
  for (const std::filesystem::path& file : files) {
    RecordingReader reader(file);
    const std::string here = play(command, pack, reader, file, replayer);
    if (!here.empty()) cut += (cut.empty() ? "" : "; ") + here;
  }
  if (replayer.frames().empty()) {
    const std::string because = cut.empty() ? "" : ": " + cut;
    if (!command.frame) fail(command.folder.string(), "there is no whole frame in the recording{}", because);
    fail(command.folder.string(), "frame {} is not {}in the recording{}", *command.frame,
         cut.empty() ? "" : "whole ", because);
  }
  if (!cut.empty()) notice("replay: {}", cut);
  if (claimed && cut.empty()) claimed->finish();
  const nlohmann::json& last = replayer.frames().back();
  if (command.frame) {
    fmt::print("frame {}: {} drawables, {} triangles, picture {}\n", *command.frame,
               last["visible"].get<uint64_t>(), last["drawn_triangles"].get<uint64_t>(),
               last["picture_hash"].get<std::string>());
  } else {
    fmt::print("{} frames\n", replayer.frames().size());
  }
  nlohmann::json report = {{"frames", replayer.frames()}, {"cut", !cut.empty()}};
  add_device(report, device.names);
  write_json(command.json, report);
  return 0;
}

}  // namespace

void add_replay(CLI::App& app, Action& action) {
  auto command = std::make_shared<ReplayCommand>();
  CLI::App* sub = app.add_subcommand("replay", "Show frames of a recorded session again, in one process");
  command->words = sub;
  sub->footer("Example: triptych replay recording --frame 17 -o frame-17.png");
  add_common_flags(*sub, command->json);
  sub->add_option("folder", command->folder, "The folder that session --record wrote")
      ->required()
      ->type_name("DIR");
  auto* frame = sub->add_option("--frame", command->frame, "The frame to show; -o is a PNG file")
                    ->check(whole_number(0, max_frames));
  sub->add_option("--frames", "Show all frames; -o is a folder")
      ->check(one_of({"all"}))
      ->type_name("all")
      ->excludes(frame);
  sub->add_option("-o,--output", command->output, "The picture, or with --frames the folder for pictures")
      ->required()
      ->type_name("PATH");
  sub->add_option("--pack", command->pack, "The pack, if it was moved")->type_name("FILE.tpk");
  add_device_flags(*sub, command->device);
  sub->add_flag("--partial", command->partial, "Accept a recording that ends too soon");
  sub->callback([command, sub, &action] {
    if (sub->count("--frame") + sub->count("--frames") == 0) throw CLI::RequiredError("--frame or --frames");
    action = [command] { return run(*command); };
  });
}

}  // namespace triptych
