#include "session/session_run.hpp"

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/notice.hpp"
#include "base/parse_json.hpp"
#include "base/partial_files.hpp"
#include "base/signals.hpp"
#include "measure/frame_journal.hpp"
#include "measure/json.hpp"
#include "measure/timeline_trace.hpp"
#include "protocol/listener.hpp"
#include "protocol/recording.hpp"
#include "session/child_processes.hpp"
#include "session/open_pack.hpp"
#include "session/role_arguments.hpp"
#include "session/temporary_folder.hpp"
#include "session/viewpoint_frames.hpp"
#include "session/window_source.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
#include <random>

namespace triptych {

namespace {

/// Starts each role, again where it is killed, and gathers what all of its processes recorded.
class Supervisor {
 public:
  Supervisor(const SessionOptions& options, uint64_t pack_hash);
  SessionOutcome run();

 private:
  static constexpr size_t count = all_roles.size();

  using Clock = std::chrono::steady_clock;
  /// What became of a role's processes.
  struct Life {
    std::vector<std::filesystem::path> files;  ///< one a process
    size_t restarts = 0;
    std::chrono::milliseconds pause{0};      ///< before the next start after an error
    std::optional<Clock::time_point> due{};  ///< of the next start
  };
  Life& life(Role role) { return lives_[static_cast<size_t>(role)]; }
  const Life& life(Role role) const { return lives_[static_cast<size_t>(role)]; }

  /// A render node that is started again reads what the first one read, whatever became of the file.
  std::filesystem::path own_copy(const std::filesystem::path& file, const std::string& name) const;
  void start(Role role);
  /// True where the session is over. Error where it cannot go on: without a render node.
  bool take_end(Role role, const ChildProcesses::Ended& ended);
  void lose_switch_node(Role role, const ChildProcesses::Ended& ended);
  bool may_restart(Role role, const ChildProcesses::Ended& ended);
  void start_those_that_are_due();
  RoleRecord record_of(Role role) const;
  void write_timeline() const;

  const SessionOptions& options_;
  SessionSetup setup_;
  Listener render_listener_, switch_listener_;  ///< the second for a session on this machine alone
  TemporaryFolder folder_;
  std::array<Life, count> lives_;
  SessionOutcome outcome_;
  ChildProcesses children_;
};

RoleRecord parse_record(const std::string& text, const std::string& place) {
  return role_record_from_json(parse_json(text, place), place);
}

/// As the command line names it.
const std::string& short_name(Role role) {
  static const std::array<std::string, 3> names = {"render", "switch 0", "switch 1"};
  return names[static_cast<size_t>(role)];
}

SessionSetup setup_of(const SessionOptions& options) {
  SessionSetup setup;
  if (!options.hosts.empty()) setup.hosts = read_hosts(options.hosts, options.run.pack.string());
  return setup;
}

Supervisor::Supervisor(const SessionOptions& options, uint64_t pack_hash)
    : options_(options),
      setup_(setup_of(options)),
      render_listener_(setup_.hosts ? setup_.hosts->render : Address{"127.0.0.1", options.port}),
      switch_listener_(Address{"127.0.0.1", static_cast<uint16_t>(options.port ? options.port + 1 : 0)}) {
  setup_.session = std::random_device()() | 1u;
  setup_.render_listener = &render_listener_;
  setup_.switch_listener = &switch_listener_;
  setup_.pack_hash = pack_hash;
  setup_.journal = folder_.path() / "frames";
  setup_.place = folder_.path() / "place.json";
  setup_.path = own_copy(options.run.path, "path.json");
  setup_.bcf = own_copy(options.viewpoint.bcf, "viewpoints.bcfzip");
}

std::filesystem::path Supervisor::own_copy(const std::filesystem::path& file, const std::string& name) const {
  if (file.empty()) return {};
  std::filesystem::path copy = folder_.path() / name;
  std::error_code error;
  std::filesystem::copy_file(file, copy, error);
  if (error) fail(copy.string(), "cannot be copied from {}: {}", file.string(), error.message());
  return copy;
}

void Supervisor::start(Role role) {
  std::vector<std::filesystem::path>& files = life(role).files;
  const bool elsewhere = setup_.hosts && role != Role::render;
  files.push_back(folder_.path() / fmt::format("{}-{}.json", short_name(role), files.size()));
  std::vector<std::string> arguments =
      role == Role::render ? render_arguments(options_, setup_) : switch_arguments(options_, setup_, role);
  if (!elsewhere) arguments.insert(arguments.end(), {"--json", files.back().string()});
  render_listener_.set_inherited(role == Role::render);
  switch_listener_.set_inherited(role == Role::switch_0);
  const Host* host = elsewhere ? &setup_.hosts->switch_nodes[role == Role::switch_0 ? 0 : 1] : nullptr;
  const pid_t pid =
      host ? children_.start_line(short_name(role), launch_line(*setup_.hosts, *host, arguments), host->name)
           : children_.start(short_name(role), arguments);
  render_listener_.set_inherited(false);
  switch_listener_.set_inherited(false);
  outcome_.roles.emplace_back(short_name(role), pid);
  notice("role {} is process {}{}", short_name(role), pid, host ? ", on " + host->name : "");
}

bool Supervisor::may_restart(Role role, const ChildProcesses::Ended& ended) {
  if (life(role).restarts == options_.restarts) return false;
  ++life(role).restarts;
  outcome_.restarted.push_back({ended.name, ended.pid, ended.reason});
  return true;
}

bool Supervisor::take_end(Role role, const ChildProcesses::Ended& ended) {
  if (role != Role::render) {
    lose_switch_node(role, ended);
    return false;
  }
  // Pictures that it left half written.
  if (!options_.output.empty()) remove_forsaken_partial_files(options_.output);
  constexpr int by_signal = 128;
  if (ended.signal == 0 && ended.exit_code > by_signal) {
    notice("session: {} was told to end", ended.place);
    outcome_.exit_code = ended.exit_code;
    outcome_.stopped = true;
    return true;
  }
  if (ended.signal == 0 && ended.exit_code == 0) return true;
  if (ended.signal == 0) fail(ended.place, "{}", ended.reason);
  if (!may_restart(role, ended)) fail(ended.place, "{}, after {} restarts", ended.reason, options_.restarts);
  notice("session: {} {}; starts it again", ended.place, ended.reason);
  start(role);
  return false;
}

void Supervisor::lose_switch_node(Role role, const ChildProcesses::Ended& ended) {
  using std::chrono::milliseconds;
  constexpr milliseconds first_pause(500), longest_pause(30'000);
  constexpr double settled_s = 60;
  Life& own = life(role);
  if (ended.signal == 0 && ended.exit_code == 0) {
    // It ends like this where the session does; then the render node is writing its last pictures.
    own.due = Clock::now() + std::chrono::seconds(10);
    return;
  }
  // Another machine that cannot be reached, or does not start the role, may do so in an hour: such tries cost
  // nothing. The command that starts a role there ends with 128 and more where that is killed, and with 255
  // where the machine is not reached.
  const bool killed = ended.exit_code > 128 && ended.exit_code < 255;
  const bool counts = !setup_.hosts || killed;
  if (counts && !may_restart(role, ended)) {
    notice("session: {}: {}, after {} restarts; goes on without it", ended.place, ended.reason,
           options_.restarts);
    return;
  }
  if (!counts) outcome_.restarted.push_back({ended.name, ended.pid, ended.reason});
  if (ended.signal != 0) {
    notice("session: {} {}; starts it again", ended.place, ended.reason);
    own.pause = milliseconds(0);
  } else {
    const bool anew = own.pause == milliseconds(0) || ended.seconds > settled_s;
    own.pause = anew ? first_pause : std::min(2 * own.pause, longest_pause);
    notice("session: {}: {}; goes on without it, and starts it again in {:.3g} s", ended.place, ended.reason,
           std::chrono::duration<double>(own.pause).count());
  }
  own.due = Clock::now() + own.pause;
}

void Supervisor::start_those_that_are_due() {
  for (const Role role : all_roles) {
    if (!life(role).due || Clock::now() < *life(role).due) continue;
    life(role).due.reset();
    try {
      start(role);
    } catch (const Error& error) {  // there may be too many processes, or descriptors, just now
      notice("session: {}; goes on without it", error.what());
      life(role).due = Clock::now() + std::chrono::seconds(1);
    }
  }
}

RoleRecord Supervisor::record_of(Role role) const {
  RoleRecord sum;
  for (const std::filesystem::path& file : life(role).files) {
    if (!std::filesystem::exists(file)) continue;  // of a process that was killed
    add_record(sum, parse_record(read_text_file(file), file.string()));
  }
  for (const std::string& line : children_.records(short_name(role))) {
    try {
      add_record(sum, parse_record(line, short_name(role)));
    } catch (const Error& error) {  // of a role on another machine, which ends no session
      notice("session: the record is left out: {}", error.what());
    }
  }
  if (role == Role::render) sum.frames = read_frame_journal(setup_.journal);
  return sum;
}

void Supervisor::write_timeline() const {
  if (options_.timeline.empty()) return;
  std::vector<ProcessTimeline> timelines;
  for (const RoleRecord& record : outcome_.records) timelines.push_back(record.timeline);
  write_json(options_.timeline, chrome_trace(timelines, outcome_.records.front().clocks));
}

SessionOutcome Supervisor::run() {
  for (const Role role : all_roles) start(role);
  // On a machine that is busy with other things the last pictures take a while.
  constexpr std::chrono::milliseconds grace(3000);
  for (bool over = false; !over;) {
    if (stop_requested()) {
      outcome_.stopped = true;
      if (!options_.until_told) outcome_.exit_code = interrupted_exit_code();
      break;
    }
    start_those_that_are_due();
    const auto ended = children_.wait_for_one();
    // A terminal's Ctrl-C reaches this process and its roles together.
    if (!ended || stop_requested()) continue;
    const auto role = std::find_if(all_roles.begin(), all_roles.end(),
                                   [&](Role candidate) { return short_name(candidate) == ended->name; });
    over = take_end(*role, *ended);
  }
  children_.end_all(grace);
  mend_frame_journal(setup_.journal);
  for (const Role role : all_roles) outcome_.records.push_back(record_of(role));
  write_timeline();
  return std::move(outcome_);
}

/// What the roles of this machine draw with, so that a machine without OpenGL is told so once, and not by
/// each of them. A window has OpenGL of its own, and other machines may.
DeviceKind device_of_all(const SessionOptions& options) {
  const DeviceKind wanted = options.run.device.kind;
  if (options.window || wanted == DeviceKind::cpu) return wanted;
  const ChosenDevice chosen = choose_device(options.run.device);
  return options.hosts.empty() ? chosen.options.kind : wanted;
}

}  // namespace

SessionOutcome run_session(const SessionOptions& asked) {
  stop_requested();  // from here on a signal ends the session properly
  SessionOptions options = asked;
  // Errors of the input are reported once, here, before any role is started.
  uint64_t pack_hash = 0;
  HiddenName hidden;
  {
    const Pack pack = open_pack(options.run.pack);
    pack_hash = pack.content_hash();
    ViewerOptions at_first = viewer_options(options.run, pack);
    begin_at_viewpoint(options.viewpoint, pack, at_first, false);
    hidden = at_first.hiding.name;
    if (!options.run.path.empty()) load_frames(options.run, pack.skeleton());
  }
  options.run.device.kind = device_of_all(options);
  if (!options.output.empty()) make_folder(options.output);
  for (const Role role : all_roles) {
    if (options.record.empty() || recordings_of(role, options.record).empty()) continue;
    fail(options.record.string(), "holds the recording of a session already");
  }
  SessionOutcome outcome = Supervisor(options, pack_hash).run();
  outcome.hidden = hidden;
  return outcome;
}

}  // namespace triptych
