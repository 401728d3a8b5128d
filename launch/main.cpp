// The program `triptych`: one file per subcommand; errors are printed here, on one line.
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/notice.hpp"
#include "launch/answering.hpp"
#include "launch/command.hpp"
#include "launch/defaults.hpp"
#include "launch/named_files.hpp"
#include "launch/usage.hpp"
#include "launch/version.hpp"
#include "measure/json.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <locale>
#include <new>
#include <optional>
#include <unistd.h>

namespace {

/// Opens standard streams that were closed: otherwise the next file that is opened would get their output.
void open_standard_streams() {
  while (true) {
    const int descriptor = ::open("/dev/null", O_RDWR);
    if (descriptor > STDERR_FILENO) ::close(descriptor);
    if (descriptor < 0 || descriptor > STDERR_FILENO) return;
  }
}

/// Prints the line that ends a run; where standard error cannot be written, the exit code must do.
int end_with(const std::string& line, int code) {
  triptych::notice("triptych: {}", line);
  return code;
}

/// What went wrong, where a library says less than a user needs.
std::string explained(const std::exception& error) {
  // The standard library and TBB pass on what the system said.
  const std::string text = error.what();
  if (text.ends_with(std::strerror(EAGAIN)))
    return "threads: no more can be started: processes (ulimit -u) or address space (ulimit -v) are too "
           "limited";
  return text;
}

/// Whether the parsed command's JSON goes to standard output.
bool prints_json(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->results()) {
      if (triptych::is_standard_output(*option, name)) return true;
    }
  }
  const auto chosen = app.get_subcommands();
  return std::any_of(chosen.begin(), chosen.end(), [](const CLI::App* sub) { return prints_json(*sub); });
}

/// failed: the exit code of errors, if the chosen command has its own.
void add_commands(CLI::App& app, triptych::Action& action, int& failed) {
  app.require_subcommand(1);
  app.set_version_flag("-V,--version", triptych::version_text,
                       "Print version, commit, how it was built and what it draws with, and exit");
  app.footer("Defaults of flags: triptych.toml, here or in ~/.config/triptych");
  triptych::add_sample(app, action);
  triptych::add_build(app, action);
  triptych::add_info(app, action);
  triptych::add_find(app, action, failed);
  triptych::add_check(app, action);
  triptych::add_diff(app, action, failed);
  triptych::add_render(app, action);
  triptych::add_view(app, action);
  triptych::add_session(app, action);
  triptych::add_replay(app, action);
  triptych::add_explain(app, action);
  triptych::add_role(app, action);
  triptych::add_measure(app, action);
  triptych::add_report(app, action);
  triptych::add_selftest(app, action);
  triptych::add_describe(app, action);
}

constexpr int usage = 2;

/// Parses the words behind the program's name, with what triptych.toml says where they do not. The exit code
/// where that is the end.
std::optional<int> parse(CLI::App& app, std::vector<std::string> words) {
  const triptych::WordsRead line = triptych::read_words(app, words);
  const std::string name = triptych::command_name(*line.command);
  if (!line.complaint.empty()) {
    // Where --help was meant, that is said once.
    const bool meant = line.complaint.ends_with("did you mean --help?");
    triptych::notice("{}: {}{}", name, line.complaint, meant ? "" : "; " + name + " --help lists them");
    return usage;
  }
  triptych::Defaults defaults;
  // A role is told all by its session, what is hidden is for scripts, and --help tells what is so without the
  // files.
  const bool complete = line.command->get_parent() && line.command->get_require_subcommand_min() == 0;
  const bool hidden = line.command->get_group().empty();
  if (complete && !hidden && words.front() != "role" && line.given.count(line.command->get_help_ptr()) == 0) {
    try {
      defaults = triptych::read_defaults(app, line, triptych::default_files());
    } catch (const triptych::Error& error) {
      triptych::notice("triptych: {}", error.what());
      return usage;
    }
  }
  words.insert(words.begin() + static_cast<std::ptrdiff_t>(line.after_command), defaults.words.begin(),
               defaults.words.end());
  // The processes that this one starts are given all flags by it.
  ::setenv("TRIPTYCH_CONFIG", "", 1);
  try {
    std::reverse(words.begin(), words.end());
    app.parse(std::move(words));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    const std::string said = triptych::in_our_words(error);
    for (const auto& [flag, place] : defaults.places) {
      if (!said.starts_with(flag)) continue;
      triptych::notice("triptych: {}: {}", place, said);
      return usage;
    }
    triptych::notice("{0}: {1}; {0} --help says more", name, said);
    return usage;
  }
  return std::nullopt;
}

}  // namespace

int main(int argc, char** argv) {
  open_standard_streams();
  triptych::remove_partial_files_on_signals();
  std::signal(SIGXFSZ,
              SIG_IGN);  // a file beyond the size limit gives a write error instead
  // Numbers have a decimal point, whatever libraries have set before.
  std::locale::global(std::locale::classic());
  CLI::App app{"Triptych: walk through models that are too big to draw"};
  triptych::Action action;
  int failed = 1;
  add_commands(app, action, failed);
  if (const auto code = parse(app, {argv + std::min(argc, 1), argv + argc})) return *code;
  try {
    if (prints_json(app)) triptych::give_standard_output_to_json();
    triptych::check_files_differ(app);
    triptych::check_files_can_be_used(app);
    const int code = action();
    if (std::fflush(stdout) != 0)
      return end_with(std::string("standard output: ") + std::strerror(errno), failed);
    return code;
  } catch (const std::bad_alloc&) {
    return end_with("memory: there is not enough", failed);
  } catch (const std::exception& error) {
    return end_with(explained(error), failed);
  }
}
