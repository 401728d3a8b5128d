// The program `triptych`: one file a subcommand; errors end here, in one line.
#include "launch/command.hpp"
#include "launch/named_files.hpp"

#include <fmt/core.h>
#include <locale>
#include <new>

int main(int argc, char** argv) {
  // Numbers have points here, whatever libraries asked for before we came.
  std::locale::global(std::locale::classic());
  CLI::App app{"Triptych: walk through models that are too big to draw"};
  app.require_subcommand(1);
  triptych::Action action;
  triptych::add_sample(app, action);
  triptych::add_build(app, action);
  triptych::add_info(app, action);
  triptych::add_check(app, action);
  triptych::add_render(app, action);
  triptych::add_view(app, action);
  triptych::add_session(app, action);
  triptych::add_replay(app, action);
  triptych::add_explain(app, action);
  triptych::add_role(app, action);
  triptych::add_measure(app, action);
  triptych::add_report(app, action);
  triptych::add_selftest(app, action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    constexpr int usage = 2;
    return app.exit(error) == 0 ? 0 : usage;
  }
  try {
    triptych::check_files_differ(app);
    return action();
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "triptych: memory: there is not enough\n");
  } catch (const std::exception& error) {
    fmt::print(stderr, "triptych: {}\n", error.what());
  }
  return 1;
}
