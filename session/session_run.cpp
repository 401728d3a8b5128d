#include "session/session_run.hpp"

#include "base/file.hpp"
#include "base/notice.hpp"
#include "base/signals.hpp"
#include "measure/frame_journal.hpp"
#include "measure/json.hpp"
#include "measure/timeline_trace.hpp"
#include "protocol/listener.hpp"
#include "protocol/recording.hpp"
#include "session/child_processes.hpp"
#include "session/role_arguments.hpp"
#include "session/temporary_folder.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <random>

namespace triptych {

namespace {

/// Removes pictures that a killed render node left half written.
void remove_partial_pictures(const std::filesystem::path& folder, pid_t pid) {
  if (folder.empty()) return;
  const std::string end = fmt::format(".partial-{}", pid);
  std::error_code ignored;  // the folder may be gone
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    if (entry.path().string().ends_with(end)) std::filesystem::remove(entry.path(), ignored);
  }
}

/// Starts each role, again where it is killed, and gathers what all of its processes recorded.
class Supervisor {
 public:
  explicit Supervisor(const SessionOptions& options);
  SessionOutcome run();

 private:
  static constexpr size_t count = all_roles.size();

  void start(Role role);
  /// Starts a role again that was killed; Error where that happened too often to the render node.
  void replace(Role role, const ChildProcesses::Ended& ended);
  RoleRecord record_of(Role role) const;
  void write_timeline() const;

  const SessionOptions& options_;
  SessionSetup setup_;
  Listener render_listener_, switch_listener_;  ///< the second for a session on this machine alone
  TemporaryFolder folder_;
  std::array<std::vector<std::filesystem::path>, count> files_;  ///< of each role, one a process
  SessionOutcome outcome_;
  ChildProcesses children_;
};

RoleRecord parse_record(const std::string& text, const std::string& place) {
  try {
    return role_record_from_json(nlohmann::json::parse(text), place);
  } catch (const nlohmann::json::exception& error) {
    fail(place, "is no JSON: {}", error.what());
  }
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

Supervisor::Supervisor(const SessionOptions& options)
    : options_(options),
      setup_(setup_of(options)),
      render_listener_(setup_.hosts ? setup_.hosts->render : Address{"127.0.0.1", options.port}),
      switch_listener_(Address{"127.0.0.1", static_cast<uint16_t>(options.port ? options.port + 1 : 0)}) {
  setup_.session = std::random_device()() | 1u;
  setup_.render_listener = &render_listener_;
  setup_.switch_listener = &switch_listener_;
  setup_.journal = folder_.path() / "frames";
}

void Supervisor::start(Role role) {
  std::vector<std::filesystem::path>& files = files_[static_cast<size_t>(role)];
  const bool elsewhere = setup_.hosts && role != Role::render;
  files.push_back(folder_.path() / fmt::format("{}-{}.json", short_name(role), files.size()));
  std::vector<std::string> arguments =
      role == Role::render ? render_arguments(options_, setup_) : switch_arguments(options_, setup_, role);
  if (!elsewhere) arguments.insert(arguments.end(), {"--json", files.back().string()});
  render_listener_.set_inherited(role == Role::render);
  switch_listener_.set_inherited(role == Role::switch_0);
  const Host* host = elsewhere ? &setup_.hosts->switch_nodes[role == Role::switch_0 ? 0 : 1] : nullptr;
  const pid_t pid = host
                        ? children_.start_line(short_name(role), launch_line(*setup_.hosts, *host, arguments))
                        : children_.start(short_name(role), arguments);
  render_listener_.set_inherited(false);
  switch_listener_.set_inherited(false);
  outcome_.roles.emplace_back(short_name(role), pid);
  notice("role {} is process {}{}", short_name(role), pid, host ? ", on " + host->name : "");
}

void Supervisor::replace(Role role, const ChildProcesses::Ended& ended) {
  remove_partial_pictures(options_.output, ended.pid);
  if (files_[static_cast<size_t>(role)].size() > options_.restarts) {
    const std::string place = fmt::format("{} (process {})", ended.name, ended.pid);
    if (role == Role::render) fail(place, "{}, after {} restarts", ended.reason, options_.restarts);
    notice("session: {}: {}, after {} restarts; goes on without it", place, ended.reason, options_.restarts);
    return;
  }
  outcome_.restarted.push_back({ended.name, ended.pid, ended.reason});
  notice("session: {} (process {}) {}; starts it again", ended.name, ended.pid, ended.reason);
  start(role);
}

RoleRecord Supervisor::record_of(Role role) const {
  RoleRecord sum;
  for (const std::filesystem::path& file : files_[static_cast<size_t>(role)]) {
    if (!std::filesystem::exists(file)) continue;  // of a process that was killed
    add_record(sum, parse_record(read_text_file(file), file.string()));
  }
  for (const std::string& line : children_.records(short_name(role))) {
    add_record(sum, parse_record(line, short_name(role)));
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
  constexpr std::chrono::milliseconds grace(1000);
  for (;;) {
    const auto ended = children_.wait_for_one(stop_requested);
    outcome_.stopped = !ended;
    if (!ended) break;
    const auto role = std::find_if(all_roles.begin(), all_roles.end(),
                                   [&](Role candidate) { return short_name(candidate) == ended->name; });
    // The command that started a role on another machine ends like this when the role is killed or the
    // network fails.
    constexpr double settled_s = 5;
    const bool lost_elsewhere =
        setup_.hosts && *role != Role::render && ended->exit_code >= 128 && ended->seconds > settled_s;
    if (ended->signal != 0 || lost_elsewhere) {
      replace(*role, *ended);
    } else if (ended->exit_code != 0) {
      children_.end_all(grace);
      fail(fmt::format("{} (process {})", ended->name, ended->pid), "{}", ended->reason);
    } else if (*role == Role::render) {
      break;
    }
  }
  children_.end_all(grace);
  mend_frame_journal(setup_.journal);
  for (const Role role : all_roles) outcome_.records.push_back(record_of(role));
  write_timeline();
  return std::move(outcome_);
}

}  // namespace

SessionOutcome run_session(const SessionOptions& options) {
  stop_requested();  // from here on a signal ends the session properly
  {
    // Errors of the input are reported once, here, before any role is started.
    const Pack pack(options.run.pack);
    if (!options.run.path.empty()) load_frames(options.run, pack.skeleton());
    if (!options.output.empty()) make_folder(options.output);
    for (const Role role : all_roles) {
      if (options.record.empty() || recordings_of(role, options.record).empty()) continue;
      fail(options.record.string(), "holds the recording of a session already");
    }
  }
  return Supervisor(options).run();
}

}  // namespace triptych
