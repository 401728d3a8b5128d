#include "base/file.hpp"
#include "base/hashing.hpp"
#include "base/notice.hpp"
#include "base/progress.hpp"
#include "base/timeline.hpp"
#include "measure/frame_journal.hpp"
#include "measure/json.hpp"
#include "measure/session_records.hpp"
#include "nodes/render_node.hpp"
#include "nodes/switch_node.hpp"
#include "session/meeting.hpp"
#include "session/picture_writer.hpp"
#include "session/pictures.hpp"
#include "session/window_source.hpp"

#include <array>
#include <csignal>
#include <thread>
#include <unistd.h>

namespace triptych {

namespace {

/// Standard input ends with whoever started this role from another machine: then it is told to end.
void end_with_stdin() {
  std::thread([] {
    std::array<char, 256> ignored{};
    while (::read(STDIN_FILENO, ignored.data(), ignored.size()) > 0) {
    }
    ::kill(::getpid(), SIGTERM);
  }).detach();
}

}  // namespace

int run_switch(const RoleCommand& command) {
  stop_requested();  // from here on a signal ends the role in good order
  if (command.end_with_stdin) end_with_stdin();
  const Pack pack(command.run.pack);
  const auto context = make_context(command.run.context);
  const Meeting meeting(command, pack, context->names());
  RoleRecord record;
  record.gl = context->names();
  record.raster = raster_verdict();
  SwitchNodeOptions options{
      .device = {command.run.test}, .cull = command.cull, .connect = {}, .on_epoch_end = {}};
  options.connect = [&](bool again) {
    return again ? meeting.connect_again(stop_requested) : meeting.connect(stop_requested);
  };
  options.on_epoch_end = [&](const Mailbox& mailbox, const std::string& reason) {
    add_sockets(record.sockets, sockets_of(command.self, mailbox));
    add_waiting(record.most_waiting, mailbox.most_waiting());
    if (!reason.empty()) notice("{}: {}; looks for both peers again", role_name(command.self), reason);
  };
  const SwitchNodeSummary done = run_switch_node(pack, command.self, options);
  notice("{}: {} frames culled, {} occlusion representations, {} epochs", role_name(command.self),
         done.culled, done.represented, done.epochs);
  record.timeline = own_timeline(role_name(command.self));
  write_json(command.run.json, to_json(record));
  if (command.tell_record) notice("triptych-record: {}", json_text(to_json(record)));
  return 0;
}

namespace {

/// Where the render node's records go: to the journal, or all to the end. Visible sets are kept on request
/// alone.
class Records {
 public:
  explicit Records(const RoleCommand& command) : keep_sets_(command.hash) {
    if (!command.journal.empty()) journal_.emplace(command.journal);
  }
  void add(FrameRecord record) {
    if (!keep_sets_) record.visible = {};
    if (journal_) return journal_->add(record);
    kept_.push_back(std::move(record));
  }
  const std::vector<FrameRecord>& kept() const { return kept_; }

 private:
  bool keep_sets_;
  std::optional<FrameJournal> journal_;
  std::vector<FrameRecord> kept_;
};

/// The path's frames, over and over. Error where those are more than frame numbers.
FrameSource path_frames(std::vector<FrameRequest> once, uint32_t first, size_t loop) {
  if (loop > most_frames / once.size()) fail("--loop", "{} times {} frames are too many", loop, once.size());
  const auto count = static_cast<uint32_t>(once.size() * loop);
  return {.first = first, .count = count, .frame = [once = std::move(once)](uint32_t number) {
            FrameRequest frame = once[number % once.size()];
            frame.number = number;
            return frame;
          }};
}

}  // namespace

int run_render(const RoleCommand& command) {
  stop_requested();
  const Pack pack(command.run.pack);
  std::optional<WindowSource> window;
  std::unique_ptr<Context> context;
  if (command.window) {
    window.emplace(pack, viewer_options(command.run));
  } else {
    context = make_context(command.run.context);
  }
  const DeviceNames& gl = window ? window->names() : context->names();
  const FrameSource frames =
      window ? window->frames(command.begin)
             : path_frames(load_frames(command.run, pack.skeleton()), command.begin, command.loop);
  if (!command.output.empty()) make_folder(command.output);
  const Meeting meeting(command, pack, gl);
  RoleRecord role;
  role.gl = gl;
  role.raster = raster_verdict();
  Records records(command);
  PictureWriter writer;
  RenderNodeSummary done;
  if (frames.first < frames.count) {
    Progress progress("session", window ? 0 : frames.count - frames.first);
    RenderNodeOptions options{
        .rate = command.rate,
        .timeout = std::chrono::milliseconds(static_cast<int64_t>(command.timeout_ms)),
        .device = {command.run.test},
        .cull = command.cull,
        .connect = [&](const std::function<bool()>& stop) { return meeting.connect(stop); },
        .on_epoch_end = {},
        .begin_alone = command.begin > 0,
        .on_picture = {}};
    options.on_epoch_end = [&](const Mailbox& mailbox, const std::string&) {
      add_sockets(role.sockets, sockets_of(Role::render, mailbox));
      add_waiting(role.most_waiting, mailbox.most_waiting());
    };
    options.on_clocks = [&](const std::vector<PeerClock>& clocks) { role.clocks = clocks; };
    options.show = [&](const FrameRequest& frame, const FrameRecord& record, LocalPipeline& stages) {
      if (record.fallback) meeting.record_alone(frame);
      if (window) window->show(frame, record, stages);
    };
    options.on_picture = [&](FrameRecord record, const FrameTarget& target) {
      progress.advance();
      if (!command.hash && command.output.empty()) return records.add(std::move(record));
      std::vector<uint8_t> colors = target.read_colors();
      if (command.hash) record.picture_hash = hash_values(std::span<const uint8_t>(colors));
      if (command.output.empty()) return records.add(std::move(record));
      const std::filesystem::path file = command.output / picture_name(record.number);
      // A frame counts as drawn once its picture is there.
      writer.add(file, target.width(), target.height(), std::move(colors),
                 [&records, record = std::move(record)] { records.add(record); });
    };
    done = run_render_node(pack, frames, options);
  }
  writer.finish();
  notice("render node: {} frames, {} of them alone, {} epochs", done.frames, done.alone, done.epochs);
  role.frames = records.kept();
  role.timeline = own_timeline(role_name(Role::render));
  write_json(command.run.json, to_json(role));
  return 0;
}

}  // namespace triptych
