// The program `triptych`: one file per subcommand; errors are printed here, on one line.
#include "base/file.hpp"
#include "base/notice.hpp"
#include "launch/diff.hpp"
#include "launch/named_files.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <locale>
#include <new>
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

/// The program and the subcommands of the command line, as typed.
std::string command_name(const CLI::App& app) {
  std::string name = "triptych";
  for (const CLI::App* at = &app; !at->get_subcommands().empty();) {
    at = at->get_subcommands().front();
    name += " " + at->get_name();
  }
  return name;
}

/// The first word that should be a subcommand but is not one; null if there is none.
const char* unknown_subcommand(CLI::App& app, int argc, char** argv) {
  CLI::App* at = &app;
  for (int i = 1; i < argc && argv[i][0] != '-'; ++i) {
    const auto all = at->get_subcommands([](CLI::App*) { return true; });
    const auto named =
        std::find_if(all.begin(), all.end(), [&](CLI::App* sub) { return sub->check_name(argv[i]); });
    if (named == all.end()) return all.empty() ? nullptr : argv[i];
    at = *named;
  }
  return nullptr;
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
  app.require_subcommand(1);
  triptych::Action action;
  triptych::add_sample(app, action);
  triptych::add_build(app, action);
  triptych::add_info(app, action);
  triptych::add_check(app, action);
  int failed = 1;
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
  constexpr int usage = 2;
  if (const char* word = unknown_subcommand(app, argc, argv)) {
    triptych::notice("triptych: there is no subcommand \"{}\"; --help lists them", word);
    return usage;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help
    triptych::notice("{0}: {1}; {0} --help says more", command_name(app), error.what());
    return usage;
  }
  try {
    triptych::check_files_differ(app);
    triptych::check_files_can_be_used(app);
    const int code = action();
    if (std::fflush(stdout) != 0)
      return end_with(std::string("standard output: ") + std::strerror(errno), failed);
    return code;
  } catch (const std::bad_alloc&) {
    return end_with("memory: there is not enough", failed);
  } catch (const std::exception& error) {
    return end_with(error.what(), failed);
  }
}
