#include "launch/session_flags.hpp"

#include "launch/hide_flags.hpp"
#include "launch/number_flags.hpp"

namespace triptych {

void add_waiting_flags(CLI::App& command, double& timeout_ms, double& gather_s) {
  command
      .add_option("--timeout", timeout_ms,
                  "Milliseconds to wait for a frame's visible set before the render node draws by itself, or "
                  "four times what frames take")
      ->check(number_between(1, 1000 * max_seconds))
      ->capture_default_str();
  command
      .add_option("--gather", gather_s,
                  "Seconds that the first frame may wait for both switch nodes; at 0 the render node begins "
                  "alone, and they join it")
      ->check(number_between(0, max_seconds))
      ->take_last()
      ->capture_default_str();
}

void add_connect_timeout_flag(CLI::App& command, double& connect_timeout_s) {
  command
      .add_option(
          "--connect-timeout", connect_timeout_s,
          "Seconds that a search for the other roles takes; then it says who is missing, and the next "
          "one begins")
      ->check(number_between(0.001, max_seconds))
      ->capture_default_str();
}

void add_until_told_flag(CLI::App& command, bool& until_told) {
  command
      .add_flag(
          "--until-told", until_told,
          "Play the path over and over until a signal comes, which is the regular end then: exit code 0")
      ->excludes("--loop");
}

void add_session_flags(CLI::App& command, SessionOptions& options) {
  add_picture_flags(command, options.run);
  add_hide_flags(command, options.run);
  command.add_option("--loop", options.loop, "How often the path is played")
      ->check(whole_number(1, max_frames));
  command.add_option("--rate", options.rate, "Cameras released per second (default: as fast as frames come)")
      ->check(number_between(min_rate, max_rate));
  add_exact_cull_flag(command, options.strategy);
  add_batch_flag(command, options.batches);
  command.add_option("--hosts", options.hosts, "Run the switch nodes on the machines that this file names")
      ->type_name("HOSTS.toml");
  command.add_option("--key-file", options.key_file, "Encrypt between the roles of this machine, too")
      ->type_name("FILE")
      ->excludes("--hosts");
  command.add_flag("--insecure", options.insecure,
                   "Allow other machines without a key: nothing is encrypted, anybody may take a role");
  add_waiting_flags(command, options.timeout_ms, options.gather_s);
  add_connect_timeout_flag(command, options.connect_timeout_s);
  command.add_option("--restarts", options.restarts, "How often a role that is killed is started again")
      ->check(whole_number(0, max_frames))
      ->capture_default_str();
  add_timeline_flag(command, options.timeline);
  command.add_option("--record", options.record, "Folder to keep every message in; replay shows them again")
      ->type_name("DIR");
  command
      .add_option("--port", options.port,
                  "The render node's port; switch node 0 takes the next one (default: free ones)")
      ->check(whole_number(1, 65534));
}

}  // namespace triptych
