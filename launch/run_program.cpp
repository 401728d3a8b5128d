#include "launch/run_program.hpp"

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/inject.hpp"
#include "base/parse_json.hpp"
#include "base/threads.hpp"
#include "session/child_processes.hpp"

namespace triptych {

nlohmann::json run_program(const std::string& name, std::vector<std::string> arguments,
                           const std::filesystem::path& folder, bool (*stop)(),
                           const std::function<void(pid_t)>& started) {
  const std::filesystem::path json = folder / (name + ".json");
  arguments.insert(arguments.end(), {"--json", json.string()});
  if (const unsigned threads = thread_count_limit())
    arguments.insert(arguments.end(), {"--threads", std::to_string(threads)});
  for (const std::string& fault : injected_names()) arguments.insert(arguments.end(), {"--inject", fault});
  stop();  // may install handlers: from here on a signal ends the child first
  ChildProcesses child;
  const pid_t process = child.start(name, arguments, ChildProcesses::Output::as_error);
  if (started) started(process);
  if (!child.wait(stop)) fail(name, "was told to end");
  return parse_json(read_text_file(json), json.string());
}

nlohmann::json run_build(const BuildFlags& flags, const std::filesystem::path& pack, bool (*stop)(),
                         const std::function<void(pid_t)>& started) {
  std::vector<std::string> arguments = {"build"};
  for (const std::string& argument : build_arguments(flags)) arguments.push_back(argument);
  arguments.insert(arguments.end(), {"-o", pack.string()});
  return run_program("build", arguments, pack.parent_path(), stop, started);
}

}  // namespace triptych
