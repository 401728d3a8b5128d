#include "launch/session_run.hpp"

#include "base/file.hpp"
#include "base/inject.hpp"
#include "launch/child_processes.hpp"
#include "launch/temporary_folder.hpp"
#include "measure/json.hpp"
#include "measure/timeline_trace.hpp"
#include "nodes/inbox.hpp"
#include "protocol/listener.hpp"
#include "protocol/recording.hpp"

#include <fmt/core.h>
#include <random>

namespace triptych {

namespace {

std::vector<std::string> shared_arguments(const SessionOptions& options, uint64_t session) {
  std::vector<std::string> arguments = {options.run.pack.string(),
                                        "--session",
                                        std::to_string(session),
                                        "--context",
                                        options.run.context == ContextKind::egl ? "egl" : "osmesa",
                                        "--test",
                                        options.run.test == TestKind::storage ? "storage" : "queries"};
  if (!options.timeline.empty()) arguments.push_back("--timeline");
  if (!options.record.empty()) arguments.insert(arguments.end(), {"--record", options.record.string()});
  for (const std::string& name : injected_names()) arguments.insert(arguments.end(), {"--inject", name});
  return arguments;
}

void append(std::vector<std::string>& arguments, std::initializer_list<std::string> more) {
  arguments.insert(arguments.end(), more);
}

RoleRecord read_record(const std::filesystem::path& file) {
  try {
    return role_record_from_json(nlohmann::json::parse(read_text_file(file)), file.string());
  } catch (const nlohmann::json::exception& error) {
    fail(file.string(), "is no JSON: {}", error.what());
  }
}

}  // namespace

void add_session_flags(CLI::App& command, SessionOptions& options) {
  add_run_flags(command, options.run);
  command.add_option("--loop", options.loop, "How often the path is played")->check(CLI::PositiveNumber);
  command.add_option("--rate", options.rate, "Cameras released a second (default: as fast as frames come)")
      ->check(CLI::PositiveNumber);
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
    load_frames(options.run, pack.skeleton());
    if (!options.output.empty()) make_folder(options.output);
    for (const Role role : all_roles) {
      if (options.record.empty() || recordings_of(role, options.record).empty()) continue;
      fail(options.record.string(), "holds the recording of a session already");
    }
  }
  Listener render_listener(Address{"127.0.0.1", options.port});
  Listener switch_listener(Address{"127.0.0.1", static_cast<uint16_t>(options.port ? options.port + 1 : 0)});
  const TemporaryFolder folder;
  const uint64_t session = std::random_device()() | 1u;
  const std::string render_address = to_text({"127.0.0.1", render_listener.port()});
  const std::string switch_address = to_text({"127.0.0.1", switch_listener.port()});
  const std::vector<std::string> names = {"render", "switch 0", "switch 1"};
  std::vector<std::filesystem::path> files;
  for (const char* name : {"render.json", "switch-0.json", "switch-1.json"})
    files.push_back(folder.path() / name);

  std::vector<std::string> render = {"role", "render"};
  for (const std::string& argument : shared_arguments(options, session)) render.push_back(argument);
  append(render, {"--json", files[0].string(), "--path", options.run.path.string(), "--size",
                  fmt::format("{}x{}", options.run.size.width, options.run.size.height), "--pixel-error",
                  fmt::format("{}", options.run.pixel_error()), "--listen-descriptor",
                  std::to_string(render_listener.descriptor()), "--loop", std::to_string(options.loop)});
  if (options.run.frames > 0) append(render, {"--frames", std::to_string(options.run.frames)});
  if (options.rate > 0) append(render, {"--rate", fmt::format("{}", options.rate)});
  if (!options.output.empty()) append(render, {"-o", options.output.string()});
  if (options.hash) append(render, {"--hash"});

  SessionOutcome outcome;
  ChildProcesses children;
  const auto start = [&](size_t role, const std::vector<std::string>& arguments) {
    const pid_t pid = children.start(names[role], arguments);
    outcome.roles.emplace_back(names[role], pid);
    fmt::print(stderr, "role {} is process {}\n", names[role], pid);
  };
  render_listener.set_inherited(true);
  start(0, render);
  render_listener.set_inherited(false);
  for (const int index : {0, 1}) {
    std::vector<std::string> arguments = {"role", "switch"};
    for (const std::string& argument : shared_arguments(options, session)) arguments.push_back(argument);
    append(arguments, {"--index", std::to_string(index), "--json",
                       files[static_cast<size_t>(index) + 1].string(), "--render", render_address});
    if (index == 0) {
      append(arguments, {"--listen-descriptor", std::to_string(switch_listener.descriptor())});
      switch_listener.set_inherited(true);
    } else {
      append(arguments, {"--switch-0", switch_address});
      switch_listener.set_inherited(false);
    }
    start(static_cast<size_t>(index) + 1, arguments);
  }
  outcome.stopped = !children.wait(stop_requested);
  if (outcome.stopped) return outcome;
  for (const std::filesystem::path& file : files) outcome.records.push_back(read_record(file));
  if (!options.timeline.empty()) {
    std::vector<ProcessTimeline> timelines;
    for (const RoleRecord& record : outcome.records) timelines.push_back(record.timeline);
    write_json(options.timeline, chrome_trace(timelines, outcome.records.front().clocks));
  }
  return outcome;
}

}  // namespace triptych
