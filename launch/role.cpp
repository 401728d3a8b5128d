#include "base/hashing.hpp"
#include "base/notice.hpp"
#include "base/progress.hpp"
#include "launch/command.hpp"
#include "launch/picture_writer.hpp"
#include "launch/pictures.hpp"
#include "measure/frame_journal.hpp"
#include "measure/json.hpp"
#include "measure/session_records.hpp"
#include "nodes/render_node.hpp"
#include "nodes/switch_node.hpp"
#include "protocol/connect.hpp"
#include "render/raster_certificate.hpp"

#include <algorithm>
#include <thread>

namespace triptych {

namespace {

/// Flags of both kinds of role.
struct RoleCommand {
  Role self = Role::render;
  RunOptions run;
  std::string listen, render_address, switch_0_address;
  int listen_descriptor = -1;
  CullOptions cull;
  uint64_t session = 0;
  double connect_timeout_s = 20;
  // of the render node alone
  std::filesystem::path output, journal;
  size_t loop = 1;
  double rate = 0;
  double timeout_ms = 500;
  uint32_t begin = 0;
  bool hash = false;
};

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
  }

  std::unique_ptr<Mailbox> connect(const std::function<bool()>& stop) const {
    return connect_session(own_, listener_ ? &*listener_ : nullptr, dial_, timeout_, stop);
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
  Hello own_;
  std::optional<Listener> listener_;
  std::map<Role, Address> dial_;
  std::chrono::milliseconds timeout_;
};

int run_switch(const RoleCommand& command) {
  stop_requested();  // from here on a signal ends the role in good order
  const Pack pack(command.run.pack);
  const auto context = make_context(command.run.context);
  const Meeting meeting(command, pack, context->names());
  RoleRecord record{{}, {}, context->names(), raster_verdict()};
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
  write_json(command.run.json, to_json(record));
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

int run_render(const RoleCommand& command) {
  stop_requested();
  const Pack pack(command.run.pack);
  const std::vector<FrameRequest> once = load_frames(command.run, pack.skeleton());
  const FrameSource frames{.first = command.begin,
                           .count = static_cast<uint32_t>(once.size() * command.loop),
                           .frame = [&](uint32_t number) {
                             FrameRequest frame = once[number % once.size()];
                             frame.number = number;
                             return frame;
                           }};
  if (!command.output.empty()) make_folder(command.output);
  const auto context = make_context(command.run.context);
  const Meeting meeting(command, pack, context->names());
  RoleRecord role{{}, {}, context->names(), raster_verdict()};
  Records records(command);
  PictureWriter writer;
  RenderNodeSummary done;
  if (frames.first < frames.count) {
    Progress progress("session", frames.count - frames.first);
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
  write_json(command.run.json, to_json(role));
  return 0;
}

void add_connection_flags(CLI::App& role, RoleCommand& command) {
  auto* listen =
      role.add_option("--listen", command.listen, "Where this role waits for others")->type_name("HOST:PORT");
  role.add_option("--listen-descriptor", command.listen_descriptor,
                  "A listening socket that this process inherited")
      ->excludes(listen);
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
  render->add_flag("--hash", render_command->hash, "Take down each picture's hash and visible set");
  render->callback([render_command, &action] {
    if (render_command->listen.empty() && render_command->listen_descriptor < 0)
      throw CLI::RequiredError("--listen");
    action = [render_command] { return run_render(*render_command); };
  });
}

}  // namespace triptych
