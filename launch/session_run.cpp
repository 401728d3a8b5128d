#include "launch/session_run.hpp"

#include "base/file.hpp"
#include "base/inject.hpp"
#include "base/notice.hpp"
#include "launch/child_processes.hpp"
#include "launch/hosts.hpp"
#include "launch/temporary_folder.hpp"
#include "measure/frame_journal.hpp"
#include "measure/json.hpp"
#include "measure/timeline_trace.hpp"
#include "nodes/inbox.hpp"
#include "protocol/listener.hpp"
#include "protocol/recording.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <random>

namespace triptych {

namespace {

std::vector<std::string> shared_arguments(const SessionOptions& options, uint64_t session,
                                          const std::string& pack, const std::string& key_file) {
  std::vector<std::string> arguments = {pack,
                                        "--session",
                                        std::to_string(session),
                                        "--context",
                                        options.run.context == ContextKind::egl ? "egl" : "osmesa",
                                        "--test",
                                        options.run.test == TestKind::storage ? "storage" : "queries"};
  if (!options.timeline.empty()) arguments.push_back("--timeline");
  if (!options.record.empty()) arguments.insert(arguments.end(), {"--record", options.record.string()});
  if (!key_file.empty()) arguments.insert(arguments.end(), {"--key-file", key_file});
  if (options.insecure) arguments.push_back("--insecure");
  for (const std::string& name : injected_names()) arguments.insert(arguments.end(), {"--inject", name});
  return arguments;
}

/// What a killed render node left half written.
void remove_partial_pictures(const std::filesystem::path& folder, pid_t pid) {
  if (folder.empty()) return;
  const std::string end = fmt::format(".partial-{}", pid);
  std::error_code ignored;  // the folder may be gone
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    if (entry.path().string().ends_with(end)) std::filesystem::remove(entry.path(), ignored);
  }
}

void append(std::vector<std::string>& arguments, std::initializer_list<std::string> more) {
  arguments.insert(arguments.end(), more);
}

/// Starts each role, as often as it takes, and gathers what all of its processes recorded.
class Cast {
 public:
  explicit Cast(const SessionOptions& options);
  SessionOutcome play();

 private:
  static constexpr size_t count = all_roles.size();

  void start(Role role);
  std::vector<std::string> render_arguments() const;
  std::vector<std::string> switch_arguments(Role role) const;
  /// Starts a role again that was killed; Error where that happened too often to the render node.
  void replace(Role role, const ChildProcesses::Ended& ended);
  RoleRecord record_of(Role role) const;
  void write_timeline() const;

  const SessionOptions& options_;
  std::optional<Hosts> hosts_;
  Listener render_listener_, switch_listener_;  ///< the second for a session on this machine alone
  TemporaryFolder folder_;
  std::filesystem::path journal_ = folder_.path() / "frames";
  uint64_t session_ = std::random_device()() | 1u;
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

Cast::Cast(const SessionOptions& options)
    : options_(options),
      hosts_(options.hosts.empty() ? std::nullopt
                                   : std::optional(read_hosts(options.hosts, options.run.pack.string()))),
      render_listener_(hosts_ ? hosts_->render : Address{"127.0.0.1", options.port}),
      switch_listener_(Address{"127.0.0.1", static_cast<uint16_t>(options.port ? options.port + 1 : 0)}) {}

std::vector<std::string> Cast::render_arguments() const {
  std::vector<std::string> arguments = {"role", "render"};
  const std::string key_file = hosts_ ? hosts_->key_file : options_.key_file.string();
  for (const auto& argument : shared_arguments(options_, session_, options_.run.pack.string(), key_file))
    arguments.push_back(argument);
  append(arguments, {"--journal", journal_.string(), "--begin", std::to_string(mend_frame_journal(journal_)),
                     "--size", fmt::format("{}x{}", options_.run.size.width, options_.run.size.height),
                     "--pixel-error", fmt::format("{}", options_.run.pixel_error()), "--listen-descriptor",
                     std::to_string(render_listener_.descriptor()), "--loop", std::to_string(options_.loop),
                     "--timeout", fmt::format("{}", options_.timeout_ms)});
  if (options_.run.frames > 0) append(arguments, {"--frames", std::to_string(options_.run.frames)});
  if (options_.rate > 0) append(arguments, {"--rate", fmt::format("{}", options_.rate)});
  if (!options_.output.empty()) append(arguments, {"-o", options_.output.string()});
  if (!options_.run.path.empty()) append(arguments, {"--path", options_.run.path.string()});
  if (options_.window) append(arguments, {"--window"});
  if (options_.hash) append(arguments, {"--hash"});
  return arguments;
}

std::vector<std::string> Cast::switch_arguments(Role role) const {
  std::vector<std::string> arguments = {"role", "switch"};
  const Host* host = hosts_ ? &hosts_->switch_nodes[role == Role::switch_0 ? 0 : 1] : nullptr;
  for (const auto& argument :
       shared_arguments(options_, session_, host ? host->pack : options_.run.pack.string(),
                        host ? host->key_file : options_.key_file.string())) {
    arguments.push_back(argument);
  }
  append(arguments,
         {"--index", role == Role::switch_0 ? "0" : "1", "--batch", std::to_string(options_.batches.front()),
          "--render", to_text(render_listener_.address())});
  if (host) {
    append(arguments, {"--end-with-stdin", "--tell-record",
                       role == Role::switch_0 ? "--listen" : "--switch-0", to_text(hosts_->switch_0)});
  } else if (role == Role::switch_0) {
    append(arguments, {"--listen-descriptor", std::to_string(switch_listener_.descriptor())});
  } else {
    append(arguments, {"--switch-0", to_text(switch_listener_.address())});
  }
  return arguments;
}

void Cast::start(Role role) {
  std::vector<std::filesystem::path>& files = files_[static_cast<size_t>(role)];
  const bool elsewhere = hosts_ && role != Role::render;
  files.push_back(folder_.path() / fmt::format("{}-{}.json", short_name(role), files.size()));
  std::vector<std::string> arguments = role == Role::render ? render_arguments() : switch_arguments(role);
  if (!elsewhere) append(arguments, {"--json", files.back().string()});
  render_listener_.set_inherited(role == Role::render);
  switch_listener_.set_inherited(role == Role::switch_0);
  const Host* host = elsewhere ? &hosts_->switch_nodes[role == Role::switch_0 ? 0 : 1] : nullptr;
  const pid_t pid = host ? children_.start_line(short_name(role), launch_line(*hosts_, *host, arguments))
                         : children_.start(short_name(role), arguments);
  render_listener_.set_inherited(false);
  switch_listener_.set_inherited(false);
  outcome_.roles.emplace_back(short_name(role), pid);
  notice("role {} is process {}{}", short_name(role), pid, host ? ", on " + host->name : "");
}

void Cast::replace(Role role, const ChildProcesses::Ended& ended) {
  remove_partial_pictures(options_.output, ended.pid);
  if (files_[static_cast<size_t>(role)].size() > options_.restarts) {
    const std::string place = fmt::format("{} (process {})", ended.name, ended.pid);
    if (role == Role::render) fail(place, "{}, after {} restarts", ended.reason, options_.restarts);
    notice("session: {}: {}, after {} restarts; goes on without it", place, ended.reason, options_.restarts);
    return;
  }
  ++outcome_.restarts;
  notice("session: {} (process {}) {}; starts it again", ended.name, ended.pid, ended.reason);
  start(role);
}

/// What a process of the role recorded, joined to what earlier ones did.
void join(RoleRecord& sum, const RoleRecord& record) {
  add_sockets(sum.sockets, record.sockets);
  sum.gl = record.gl;
  sum.raster = record.raster;
  sum.timeline.process = record.timeline.process;
  sum.timeline.spans.insert(sum.timeline.spans.end(), record.timeline.spans.begin(),
                            record.timeline.spans.end());
  sum.timeline.lost += record.timeline.lost;
  if (!record.clocks.empty()) sum.clocks = record.clocks;
}

RoleRecord Cast::record_of(Role role) const {
  RoleRecord sum;
  for (const std::filesystem::path& file : files_[static_cast<size_t>(role)]) {
    if (!std::filesystem::exists(file)) continue;  // of a process that was killed
    join(sum, parse_record(read_text_file(file), file.string()));
  }
  for (const std::string& line : children_.records(short_name(role))) {
    join(sum, parse_record(line, short_name(role)));
  }
  if (role == Role::render) sum.frames = read_frame_journal(journal_);
  return sum;
}

void Cast::write_timeline() const {
  if (options_.timeline.empty()) return;
  std::vector<ProcessTimeline> timelines;
  for (const RoleRecord& record : outcome_.records) timelines.push_back(record.timeline);
  write_json(options_.timeline, chrome_trace(timelines, outcome_.records.front().clocks));
}

SessionOutcome Cast::play() {
  for (const Role role : all_roles) start(role);
  constexpr std::chrono::milliseconds grace(1000);
  for (;;) {
    const auto ended = children_.wait_for_one(stop_requested);
    outcome_.stopped = !ended;
    if (!ended) break;
    const auto role = std::find_if(all_roles.begin(), all_roles.end(),
                                   [&](Role candidate) { return short_name(candidate) == ended->name; });
    // On another machine the command that started a role ends so when the role is killed or the network is.
    constexpr double settled_s = 5;
    const bool lost_elsewhere =
        hosts_ && *role != Role::render && ended->exit_code >= 128 && ended->seconds > settled_s;
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
  mend_frame_journal(journal_);
  for (const Role role : all_roles) outcome_.records.push_back(record_of(role));
  write_timeline();
  return std::move(outcome_);
}

}  // namespace

void add_session_flags(CLI::App& command, SessionOptions& options) {
  add_run_flags(command, options.run);
  command.add_option("--loop", options.loop, "How often the path is played")->check(CLI::PositiveNumber);
  command.add_option("--rate", options.rate, "Cameras released a second (default: as fast as frames come)")
      ->check(CLI::PositiveNumber);
  add_batch_flag(command, options.batches);
  command.add_option("--hosts", options.hosts, "Play the switch nodes on the machines that this file names")
      ->type_name("HOSTS.toml");
  command.add_option("--key-file", options.key_file, "Encrypt between the roles of this machine, too")
      ->type_name("FILE")
      ->excludes("--hosts");
  command.add_flag("--insecure", options.insecure,
                   "Allow other machines without a key: nothing is encrypted, anybody may take a role");
  command
      .add_option("--timeout", options.timeout_ms,
                  "Milliseconds to wait for a frame's visible set before the render node goes on alone")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command.add_option("--restarts", options.restarts, "How often a role that is killed is started again")
      ->capture_default_str();
  add_timeline_flag(command, options.timeline);
  command.add_option("--record", options.record, "Folder to keep every message in; replay shows them again")
      ->type_name("DIR");
  command
      .add_option("--port", options.port,
                  "The render node's port; switch node 0 takes the next one (default: free ones)")
      ->check(CLI::Range(1, 65534));
}

SessionOutcome run_session(const SessionOptions& options) {
  stop_requested();  // from here on a signal ends the session in good order
  {
    // What is wrong with the input is said once, here, before anybody is started.
    const Pack pack(options.run.pack);
    if (!options.run.path.empty()) load_frames(options.run, pack.skeleton());
    if (!options.output.empty()) make_folder(options.output);
    for (const Role role : all_roles) {
      if (options.record.empty() || recordings_of(role, options.record).empty()) continue;
      fail(options.record.string(), "holds the recording of a session already");
    }
  }
  return Cast(options).play();
}

}  // namespace triptych
