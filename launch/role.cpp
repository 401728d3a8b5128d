#include "base/hashing.hpp"
#include "base/progress.hpp"
#include "launch/command.hpp"
#include "launch/picture_writer.hpp"
#include "launch/pictures.hpp"
#include "measure/json.hpp"
#include "measure/session_records.hpp"
#include "nodes/render_node.hpp"
#include "nodes/switch_node.hpp"
#include "protocol/connect.hpp"
#include "render/raster_certificate.hpp"

namespace triptych {

namespace {

/// Flags of both kinds of role.
struct RoleCommand {
  Role self = Role::render;
  RunOptions run;
  std::string listen, render_address, switch_0_address;
  int listen_descriptor = -1;
  uint64_t session = 0;
  double connect_timeout_s = 20;
  // of the render node alone
  std::filesystem::path output;
  size_t loop = 1;
  double rate = 0;
  bool hash = false;
};

/// Of the context that is current when it is first asked for.
const std::string& raster_verdict() {
  static const std::string& verdict = verdict_name(measure_raster().verdict());
  return verdict;
}

std::unique_ptr<Mailbox> connect(const RoleCommand& command, const Pack& pack, const GlNames& gl) {
  std::optional<Listener> listener;
  if (command.listen_descriptor >= 0) {
    listener.emplace(command.listen_descriptor);
  } else if (!command.listen.empty()) {
    listener.emplace(parse_address(command.listen));
  }
  std::map<Role, Address> dial;
  if (command.self != Role::render) dial[Role::render] = parse_address(command.render_address);
  if (command.self == Role::switch_1) dial[Role::switch_0] = parse_address(command.switch_0_address);
  Hello own;
  own.role = command.self;
  own.session = command.session;
  own.pack_hash = pack.content_hash();
  own.gl_vendor = gl.vendor;
  own.gl_renderer = gl.renderer;
  own.gl_version = gl.version;
  own.raster = raster_verdict();
  const std::chrono::milliseconds timeout(static_cast<int64_t>(command.connect_timeout_s * 1000));
  return connect_session(own, listener ? &*listener : nullptr, dial, timeout);
}

int run_switch(const RoleCommand& command) {
  stop_requested();  // from here on a signal ends the role in good order
  const Pack pack(command.run.pack);
  const auto context = make_context(command.run.context);
  const auto mailbox = connect(command, pack, context->names());
  run_switch_node(pack, *mailbox, command.self, {.test = command.run.test, .batches = {}});
  write_json(command.run.json,
             to_json(RoleRecord{sockets_of(command.self, *mailbox), {}, context->names(), raster_verdict()}));
  return 0;
}

int run_render(const RoleCommand& command) {
  stop_requested();
  const Pack pack(command.run.pack);
  const std::vector<FrameRequest> once = load_frames(command.run, pack.skeleton());
  std::vector<FrameRequest> frames;
  for (size_t round = 0; round < command.loop; ++round) {
    for (FrameRequest frame : once) {
      frame.number = static_cast<uint32_t>(frames.size());
      frames.push_back(frame);
    }
  }
  if (!command.output.empty()) make_folder(command.output);
  const auto context = make_context(command.run.context);
  const auto mailbox = connect(command, pack, context->names());
  PictureWriter writer;
  std::vector<FrameRecord> records;
  {
    Progress progress("session", frames.size());
    RenderNodeOptions options{.rate = command.rate, .on_picture = {}};
    options.on_picture = [&](FrameRecord& record, const Target& target) {
      progress.advance();
      if (!command.hash && command.output.empty()) return;
      std::vector<uint8_t> colors = target.read_colors();
      if (command.hash) record.picture_hash = hash_values(std::span<const uint8_t>(colors));
      if (command.output.empty()) return;
      writer.add(command.output / picture_name(record.number), target.width(), target.height(),
                 std::move(colors));
    };
    records = run_render_node(pack, *mailbox, frames, options);
  }
  writer.finish();
  write_json(command.run.json, to_json(RoleRecord{sockets_of(Role::render, *mailbox), records,
                                                  context->names(), raster_verdict()}));
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
  render->add_flag("--hash", render_command->hash, "Take each picture's hash down in the JSON");
  render->callback([render_command, &action] {
    if (render_command->listen.empty() && render_command->listen_descriptor < 0)
      throw CLI::RequiredError("--listen");
    action = [render_command] { return run_render(*render_command); };
  });
}

}  // namespace triptych
