#include "base/clock.hpp"
#include "base/file.hpp"
#include "base/hashing.hpp"
#include "base/notice.hpp"
#include "base/progress.hpp"
#include "base/timeline.hpp"
#include "launch/command.hpp"
#include "launch/picture_writer.hpp"
#include "launch/pictures.hpp"
#include "launch/window_source.hpp"
#include "measure/frame_journal.hpp"
#include "measure/json.hpp"
#include "measure/session_records.hpp"
#include "nodes/render_node.hpp"
#include "nodes/switch_node.hpp"
#include "protocol/connect.hpp"
#include "render/raster_certificate.hpp"

#include <algorithm>
#include <array>
#include <csignal>
#include <thread>
#include <unistd.h>

namespace triptych {

namespace {

/// Flags of both kinds of role.
struct RoleCommand {
  Role self = Role::render;
  RunOptions run;
  std::string listen, render_address, switch_0_address;
  std::filesystem::path key_file;
  bool insecure = false, end_with_stdin = false, tell_record = false;
  int listen_descriptor = -1;
  CullOptions cull;
  uint64_t session = 0;
  double connect_timeout_s = 20;
  bool timeline = false, window = false;
  std::filesystem::path record;  ///< folder for the recording; none where empty
  // of the render node alone
  std::filesystem::path output, journal;
  size_t loop = 1;
  double rate = 0;
  double timeout_ms = 500;
  uint32_t begin = 0;
  bool hash = false;
};

/// Without a key a session stays on its machine, unless somebody insists.
void check_without_key(const Address& address, bool insecure) {
  if (is_loopback(address)) return;
  if (!insecure) fail(to_text(address), "is beyond this machine: give --key-file FILE, or --insecure");
  notice("{}: not encrypted; whoever reaches it can read along and take a role", to_text(address));
}

/// Of the context that is current when it is first asked for.
const std::string& raster_verdict() {
  static const std::string& verdict = verdict_name(measure_raster().verdict());
  return verdict;
}

/// How this role finds its peers, as often as it has to.
class Meeting {
 public:
  Meeting(const RoleCommand& command, const Pack& pack, const GlNames& gl)
      : timeout_(static_cast<int64_t>(command.connect_timeout_s * 1000)) {
    if (command.timeline) start_timeline();
    own_.role = command.self;
    own_.session = command.session;
    own_.pack_hash = pack.content_hash();
    own_.gl_vendor = gl.vendor;
    own_.gl_renderer = gl.renderer;
    own_.gl_version = gl.version;
    own_.raster = raster_verdict();
    if (command.listen_descriptor >= 0) {
      listener_.emplace(command.listen_descriptor);
    } else if (!command.listen.empty()) {
      listener_.emplace(parse_address(command.listen));
    }
    if (command.self != Role::render) dial_[Role::render] = parse_address(command.render_address);
    if (command.self == Role::switch_1) dial_[Role::switch_0] = parse_address(command.switch_0_address);
    if (!command.key_file.empty()) {
      key_ = read_key_file(command.key_file);
    } else {
      if (listener_) check_without_key(listener_->address(), command.insecure);
      for (const auto& [role, address] : dial_) check_without_key(address, command.insecure);
    }
    if (command.record.empty()) return;
    make_folder(command.record);
    const size_t earlier = recordings_of(command.self, command.record).size();
    recording_ = std::make_unique<RecordingWriter>(
        command.record / recording_name(command.self, earlier + 1),
        RecordingHeader{.own = own_, .pack = std::filesystem::absolute(command.run.pack).string()});
  }

  std::unique_ptr<Mailbox> connect(const std::function<bool()>& stop) const {
    auto mailbox = connect_session(own_, listener_ ? &*listener_ : nullptr, dial_, timeout_, stop,
                                   key_ ? &*key_ : nullptr);
    if (mailbox) compare_opengl(*mailbox);
    if (mailbox && recording_) {
      mailbox->observe = [this](const RecordedMessage& message) { recording_->add(message); };
    }
    return mailbox;
  }

  /// Takes down a frame that the render node drew alone: a camera that it sent to itself.
  void record_alone(const FrameRequest& frame) const {
    if (!recording_) return;
    recording_->add({.time_ms = steady_milliseconds(),
                     .sent = true,
                     .peer = own_.role,
                     .channel = Channel::camera,
                     .message = CameraMessage{frame.number, frame.view, frame.pixel_error, false, false}});
  }

  /// After a loss: tries again as long as the render node is there.
  std::unique_ptr<Mailbox> connect_again(const std::function<bool()>& stop) const {
    for (;;) {
      try {
        return connect(stop);
      } catch (const PeerDiffers&) {
        throw;
      } catch (const PeersMissing& missing) {
        if (std::count(missing.roles.begin(), missing.roles.end(), Role::render) != 0) throw;
      } catch (const Error&) {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));  // a peer that begins again as well
      }
    }
  }

 private:
  /// Only where all three agree can pictures be claimed to be identical to those of one process.
  void compare_opengl(const Mailbox& mailbox) const {
    if (own_.role != Role::render) return;
    for (const Role role : {Role::switch_0, Role::switch_1}) {
      const Hello& peer = mailbox.peer_hello(role);
      const auto text = [](const Hello& hello) {
        return fmt::format("{}, {}, {}", hello.gl_vendor, hello.gl_renderer, hello.gl_version);
      };
      if (text(peer) == text(own_)) continue;
      notice("OpenGL differs: {} has {}; {} has {}: culling is conservative", role_name(own_.role),
             text(own_), role_name(role), text(peer));
    }
  }

  Hello own_;
  std::optional<Listener> listener_;
  std::map<Role, Address> dial_;
  std::optional<SharedKey> key_;
  std::chrono::milliseconds timeout_;
  std::unique_ptr<RecordingWriter> recording_;
};

/// Standard input ends with whoever started this role from another machine: then it is told to end.
void end_with_stdin() {
  std::thread([] {
    std::array<char, 256> ignored{};
    while (::read(STDIN_FILENO, ignored.data(), ignored.size()) > 0) {
    }
    ::kill(::getpid(), SIGTERM);
  }).detach();
}

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
      .test = command.run.test, .cull = command.cull, .connect = {}, .on_epoch_end = {}};
  options.connect = [&](bool again) {
    return again ? meeting.connect_again(stop_requested) : meeting.connect(stop_requested);
  };
  options.on_epoch_end = [&](const Mailbox& mailbox, const std::string& reason) {
    add_sockets(record.sockets, sockets_of(command.self, mailbox));
    if (!reason.empty()) notice("{}: {}; looks for both peers again", role_name(command.self), reason);
  };
  const SwitchNodeSummary done = run_switch_node(pack, command.self, options);
  notice("{}: {} frames culled, {} occlusion representations, {} epochs", role_name(command.self),
         done.culled, done.represented, done.epochs);
  record.timeline = own_timeline(role_name(command.self));
  write_json(command.run.json, to_json(record));
  if (command.tell_record) notice("triptych-record: {}", to_json(record).dump());
  return 0;
}

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

/// The path's frames, over and over.
FrameSource path_frames(std::vector<FrameRequest> once, uint32_t first, size_t loop) {
  const auto count = static_cast<uint32_t>(once.size() * loop);
  return {.first = first, .count = count, .frame = [once = std::move(once)](uint32_t number) {
            FrameRequest frame = once[number % once.size()];
            frame.number = number;
            return frame;
          }};
}

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
  const GlNames& gl = window ? window->names() : context->names();
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
        .test = command.run.test,
        .cull = command.cull,
        .connect = [&](const std::function<bool()>& stop) { return meeting.connect(stop); },
        .on_epoch_end = {},
        .begin_alone = command.begin > 0,
        .on_picture = {}};
    options.on_epoch_end = [&](const Mailbox& mailbox, const std::string&) {
      add_sockets(role.sockets, sockets_of(Role::render, mailbox));
    };
    options.on_clocks = [&](const std::vector<PeerClock>& clocks) { role.clocks = clocks; };
    options.show = [&](const FrameRequest& frame, const FrameRecord& record, Fallback& stages) {
      if (record.fallback) meeting.record_alone(frame);
      if (window) window->show(frame, record, stages);
    };
    options.on_picture = [&](FrameRecord record, const Target& target) {
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

void add_connection_flags(CLI::App& role, RoleCommand& command) {
  auto* listen =
      role.add_option("--listen", command.listen, "Where this role waits for others")->type_name("HOST:PORT");
  role.add_option("--listen-descriptor", command.listen_descriptor,
                  "A listening socket that this process inherited")
      ->excludes(listen);
  role.add_flag("--timeline", command.timeline, "Take down in the JSON when each stage ran");
  role.add_option("--record", command.record, "Folder to keep every message in")->type_name("DIR");
  role.add_option("--key-file", command.key_file,
                  "Encrypt, and admit those alone who have this key (openssl rand -hex 32 > FILE; chmod 600)")
      ->type_name("FILE");
  role.add_flag("--end-with-stdin", command.end_with_stdin,
                "End when standard input does: for roles that are started from another machine");
  role.add_flag(
      "--tell-record", command.tell_record,
      "Say what the JSON would hold on standard error: for whoever started this role from another machine");
  role.add_flag("--insecure", command.insecure,
                "Allow other machines without a key: nothing is encrypted, anybody may take a role");
  role.add_option("--session", command.session, "A number that the roles of one session share");
  role.add_option("--connect-timeout", command.connect_timeout_s, "Seconds until all roles must have met")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
}

}  // namespace

void add_role(CLI::App& app, Action& action) {
  CLI::App* role = app.add_subcommand("role", "One role of a session, for machines of one's own");
  role->require_subcommand(1);
  role->footer(
      "Example, three terminals:\n"
      "  triptych role render scene.tpk --path walk.json --listen 127.0.0.1:7000 -o pictures\n"
      "  triptych role switch scene.tpk --index 0 --listen 127.0.0.1:7001 --render 127.0.0.1:7000\n"
      "  triptych role switch scene.tpk --index 1 --render 127.0.0.1:7000 --switch-0 127.0.0.1:7001");

  auto switch_command = std::make_shared<RoleCommand>();
  CLI::App* switch_node =
      role->add_subcommand("switch", "A switch node: occlusion representation and culling in turns");
  add_common_flags(*switch_node, switch_command->run.json);
  add_drawing_flags(*switch_node, switch_command->run);
  add_connection_flags(*switch_node, *switch_command);
  auto index = std::make_shared<int>(0);
  switch_node->add_option("--index", *index, "Which of both it is")->required()->check(CLI::Range(0, 1));
  switch_node->add_option("--render", switch_command->render_address, "The render node")
      ->required()
      ->type_name("HOST:PORT");
  switch_node->add_option("--switch-0", switch_command->switch_0_address, "Switch node 0, for switch node 1")
      ->type_name("HOST:PORT");
  add_batch_flag(*switch_node, switch_command->cull.packet_ids);
  switch_node->callback([switch_command, index, &action] {
    RoleCommand& command = *switch_command;
    command.self = *index == 0 ? Role::switch_0 : Role::switch_1;
    if (*index == 0 && command.listen.empty() && command.listen_descriptor < 0)
      throw CLI::RequiredError("--listen");
    if (*index == 1 && command.switch_0_address.empty()) throw CLI::RequiredError("--switch-0");
    action = [switch_command] { return run_switch(*switch_command); };
  });

  auto render_command = std::make_shared<RoleCommand>();
  CLI::App* render = role->add_subcommand("render", "The render node: sends cameras, draws pictures");
  add_run_flags(*render, render_command->run);
  add_connection_flags(*render, *render_command);
  render->add_option("-o,--output", render_command->output, "Folder for the PNG files")->type_name("DIR");
  render->add_option("--loop", render_command->loop, "How often the path is played")
      ->check(CLI::PositiveNumber);
  render->add_option("--rate", render_command->rate, "Cameras released a second")->check(CLI::PositiveNumber);
  render
      ->add_option("--timeout", render_command->timeout_ms,
                   "Milliseconds to wait for a frame's visible set before going on alone")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  render->add_option("--journal", render_command->journal, "Append each frame's record here, not to the JSON")
      ->type_name("FILE");
  render->add_option("--begin", render_command->begin,
                     "First frame: an earlier render node drew those before it");
  add_window_flag(*render, render_command->window);
  render->add_flag("--hash", render_command->hash, "Take down each picture's hash and visible set");
  render->callback([render_command, &action] {
    if (render_command->listen.empty() && render_command->listen_descriptor < 0)
      throw CLI::RequiredError("--listen");
    require_path(render_command->run, render_command->window);
    action = [render_command] { return run_render(*render_command); };
  });
}

}  // namespace triptych
