#include "launch/command.hpp"
#include "launch/hide_flags.hpp"
#include "launch/memory_flags.hpp"
#include "launch/number_flags.hpp"
#include "launch/output_folder.hpp"
#include "launch/session_flags.hpp"
#include "launch/viewpoint_flags.hpp"
#include "session/role_command.hpp"

namespace triptych {

namespace {

/// A session has claimed the folder for its roles, which inherit a socket from it.
int run_claimed(const RoleCommand& command, const std::string& line) {
  if (command.output.empty() || command.listen_descriptor >= 0) return run_render(command);
  OutputFolder claimed(command.output, line);
  const int code = run_render(command);
  // Those before --begin are an earlier process's.
  if (code == 0 && command.begin == 0) claimed.finish();
  return code;
}

void add_connection_flags(CLI::App& role, RoleCommand& command) {
  auto* listen = role.add_option("--listen", command.listen, "The address at which this role listens")
                     ->type_name("HOST:PORT");
  role.add_option("--listen-descriptor", command.listen_descriptor,
                  "A listening socket that this process inherited")
      ->check(whole_number(0, std::numeric_limits<int>::max()))
      ->excludes(listen);
  role.add_flag("--timeline", command.timeline, "Record in the JSON when each stage ran");
  role.add_option("--record", command.record, "Folder to keep every message in")->type_name("DIR");
  role.add_option(
          "--key-file", command.key_file,
          "Encrypt, and accept only peers that have this key (openssl rand -hex 32 > FILE; chmod 600)")
      ->type_name("FILE");
  role.add_flag("--end-with-stdin", command.end_with_stdin,
                "End when standard input does: for roles that are started from another machine");
  role.add_flag(
      "--tell-record", command.tell_record,
      "Print the JSON on standard error, for the session that started this role from another machine");
  role.add_flag("--insecure", command.insecure,
                "Allow other machines without a key: nothing is encrypted, anybody may take a role");
  role.add_option("--session", command.session, "A number that the roles of one session share")
      ->check(whole_number(0));
  role.add_option("--pack-hash", command.pack_hash,
                  "What the content of the pack must be, as the session has it")
      ->check(whole_number(0));
  add_connect_timeout_flag(role, command.connect_timeout_s);
  add_exact_cull_flag(role, command.strategy);
  add_memory_flags(role, command.run.device.memory);
}

}  // namespace

void add_role(CLI::App& app, Action& action) {
  CLI::App* role = app.add_subcommand("role", "Run one role of a session, to place the roles by hand");
  role->require_subcommand(1);
  role->footer(
      "Example, three terminals:\n"
      "  triptych role render scene.tpk --path walk.json --listen 127.0.0.1:7000 --gather 60 -o pictures\n"
      "  triptych role switch scene.tpk --index 0 --listen 127.0.0.1:7001 --render 127.0.0.1:7000\n"
      "  triptych role switch scene.tpk --index 1 --render 127.0.0.1:7000 --switch-0 127.0.0.1:7001");

  auto switch_command = std::make_shared<RoleCommand>();
  CLI::App* switch_node =
      role->add_subcommand("switch", "A switch node: occlusion representation and culling by turns");
  add_common_flags(*switch_node, switch_command->run.json);
  add_drawing_flags(*switch_node, switch_command->run);
  add_connection_flags(*switch_node, *switch_command);
  auto index = std::make_shared<int>(0);
  switch_node->add_option("--index", *index, "Which switch node it is")
      ->required()
      ->check(whole_number(0, 1));
  switch_node->add_option("--render", switch_command->render_address, "The render node")
      ->required()
      ->type_name("HOST:PORT");
  switch_node->add_option("--switch-0", switch_command->switch_0_address, "Switch node 0, for switch node 1")
      ->type_name("HOST:PORT");
  switch_node->add_flag("--keep-trying", switch_command->keep_trying,
                        "Go on searching where the others do not come in time at the beginning, too");
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
  add_picture_flags(*render, render_command->run);
  add_hide_flags(*render, render_command->run);
  add_target_flag(*render, render_command->run);
  add_connection_flags(*render, *render_command);
  render->add_option("-o,--output", render_command->output, "Folder for the PNG files")->type_name("DIR");
  render->add_option("--loop", render_command->loop, "How often the path is played")
      ->check(whole_number(1, max_frames));
  render->add_option("--rate", render_command->rate, "Cameras released per second")
      ->check(number_between(min_rate, max_rate));
  add_waiting_flags(*render, render_command->timeout_ms, render_command->gather_s);
  render->add_option("--journal", render_command->journal, "Append each frame's record here, not to the JSON")
      ->type_name("FILE");
  render
      ->add_option("--begin", render_command->begin,
                   "First frame: an earlier render node drew those before it")
      ->check(whole_number(0, max_frames));
  add_until_told_flag(*render, render_command->until_told);
  add_window_flag(*render, render_command->window);
  add_viewpoint_flags(*render, render_command->viewpoint);
  render->get_option("--bcf")->needs("--window");
  render
      ->add_option("--place-file", render_command->place,
                   "Keep where the person at the window stands in this file; begin there if it is there")
      ->type_name("FILE");
  render->add_flag("--hash", render_command->hash, "Record each picture's hash and visible set");
  render->callback([render_command, render, &action] {
    check_target_flag(render_command->run, render_command->strategy);
    if (render_command->listen.empty() && render_command->listen_descriptor < 0)
      throw CLI::RequiredError("--listen");
    require_path(render_command->run, render_command->window);
    action = [render_command, render] { return run_claimed(*render_command, run_line(*render)); };
  });
}

}  // namespace triptych
