#include "base/file.hpp"
#include "base/inject.hpp"
#include "base/memory.hpp"
#include "base/notice.hpp"
#include "base/signals.hpp"
#include "base/thread_name.hpp"
#include "base/timeline.hpp"
#include "measure/json.hpp"
#include "measure/session_records.hpp"
#include "nodes/render_node.hpp"
#include "nodes/switch_node.hpp"
#include "session/open_pack.hpp"
#include "session/path_source.hpp"
#include "session/render_sink.hpp"
#include "session/session_connector.hpp"
#include "session/viewpoint_frames.hpp"
#include "session/window_source.hpp"

#include <algorithm>
#include <array>
#include <thread>
#include <unistd.h>

namespace triptych {

namespace {

/// Ends this role when its standard input ends, as it does when the command that started it from another
/// machine ends.
void end_with_stdin() {
  std::thread([] {
    std::array<char, 256> ignored{};
    while (::read(STDIN_FILENO, ignored.data(), ignored.size()) > 0) {
    }
    request_stop();
  }).detach();
}

/// The role's pack. Error where it is not the one that the session began with.
Pack open_pack(const RoleCommand& command) {
  Pack pack = triptych::open_pack(command.run.pack);
  if (command.pack_hash && *command.pack_hash != pack.content_hash()) {
    fail(pack.name(),
         "is not the pack that the session began with (its content is {:016x}, not {:016x}): start the "
         "session again to see this one",
         pack.content_hash(), *command.pack_hash);
  }
  return pack;
}

/// The faults of --inject in this role's part of the session.
SessionRules injected_rules(Role self) {
  constexpr std::chrono::milliseconds slowness(20);
  const bool slow = (self == Role::render && injected(Fault::slow_render_node)) ||
                    (self == Role::switch_1 && injected(Fault::slow_switch_node));
  return {.compares_digests = !injected(Fault::no_digest),
          .withholds_added = injected(Fault::wrong_delta),
          .slowed_by = slow ? slowness : std::chrono::milliseconds(0)};
}

/// Records the figures of a switch node's epochs.
class SwitchSink : public EpochSink {
 public:
  SwitchSink(Role self, RoleRecord& record) : self_(self), record_(record) {}
  void epoch_ended(const Mailbox& mailbox, const std::string& reason) override {
    add_sockets(record_.sockets, sockets_of(self_, mailbox));
    add_backlog(record_.max_backlog, mailbox.max_backlog());
    if (!reason.empty()) notice("{}: {}; looks for both peers again", role_name(self_), reason);
  }

 private:
  Role self_;
  RoleRecord& record_;
};

}  // namespace

int run_switch(const RoleCommand& command) {
  stop_requested();  // from here on a signal ends the role properly
  name_thread(command.self == Role::switch_0 ? "triptych-sw-0" : "triptych-sw-1");
  if (command.end_with_stdin) end_with_stdin();
  const Pack pack = open_pack(command);
  const ChosenDevice device = choose_device(command.run.device);
  const SessionConnector connector(command, pack, device.names);
  RoleRecord record;
  record.device = device.names;
  record.raster = raster_verdict(device.names);
  SwitchSink sink(command.self, record);
  const SwitchNodeOptions options{.device = device.options,
                                  .strategy = command.strategy,
                                  .cull = command.cull,
                                  .connect =
                                      [&](bool again) {
                                        return again || command.keep_trying
                                                   ? connector.connect_again(stop_requested)
                                                   : connector.connect(stop_requested);
                                      },
                                  .session_rules = injected_rules(command.self)};
  const SwitchNodeSummary done = run_switch_node(pack, command.self, sink, options);
  record.memory = done.memory;
  record.peak_rss_bytes = peak_resident_bytes();
  notice("{}: {} frames culled, {} occlusion representations, {} epochs", role_name(command.self),
         done.culled, done.represented, done.epochs);
  record.timeline = own_timeline(role_name(command.self));
  write_json(command.run.json, to_json(record));
  if (command.tell_record) notice("triptych-record: {}", json_text(to_json(record)));
  return interrupted_exit_code();
}

int run_render(const RoleCommand& command) {
  stop_requested();
  name_thread("triptych-render");
  const Pack pack = open_pack(command);
  std::unique_ptr<WindowSource> window;
  std::unique_ptr<FrameSource> path;
  ChosenDevice device;
  if (command.window) {
    ViewerOptions options = viewer_options(command.run, pack);
    if (!command.output.empty()) options.pictures = command.output;
    options.place = command.place;
    begin_at_viewpoint(command.viewpoint, pack, options);
    window = std::make_unique<WindowSource>(pack, options, command.begin);
    device = choose_device(command.run.device, window->names());
  } else {
    device = choose_device(command.run.device);
    std::vector<FrameRequest> frames = load_frames(command.run, pack);
    const size_t loop = command.until_told ? max_frames / frames.size() : command.loop;
    path = std::make_unique<PathSource>(std::move(frames), command.begin, loop);
  }
  FrameSource& source = window ? *window : *path;
  if (!command.output.empty()) make_folder(command.output);
  const SessionConnector connector(command, pack, device.names);
  RenderSink sink(command, connector, window.get(), source.numbers());
  RenderNodeSummary done;
  if (source.numbers().first < source.numbers().count) {
    done = run_render_node(
        pack, source, sink,
        {.rate = command.rate,
         .timeout = std::chrono::milliseconds(static_cast<int64_t>(command.timeout_ms)),
         .gather = std::chrono::milliseconds(static_cast<int64_t>(1000 * command.gather_s)),
         .device = device.options,
         .no_pixel_error =
             window ? MemoryKeeper::NoPixelError::leaves_out : MemoryKeeper::NoPixelError::fails,
         .strategy = command.strategy,
         .cull = command.cull,
         .connect = [&](const std::function<bool()>& stop) { return connector.connect_again(stop); },
         .successor = command.begin > 0,
         .session_rules = injected_rules(Role::render),
         .target_ms = command.run.target_ms});
  }
  RoleRecord record = sink.finish();
  notice("render node: {} frames, {} of them by itself, {} epochs", done.frames, done.fallback_frames,
         done.epochs);
  record.device = device.names;
  record.raster = raster_verdict(device.names);
  record.cost_coefficients = done.cost_coefficients;
  record.memory = done.memory;
  record.peak_rss_bytes = peak_resident_bytes();
  record.timeline = own_timeline(role_name(Role::render));
  write_json(command.run.json, to_json(record));
  const FrameSource::Numbers numbers = source.numbers();
  const bool complete = done.frames == numbers.count - std::min(numbers.first, numbers.count);
  return complete || command.until_told ? 0 : interrupted_exit_code();
}

}  // namespace triptych
