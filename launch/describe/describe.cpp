// What the installation makes of the command line's own descriptions; not listed by --help.
#include "launch/choice_flag.hpp"
#include "launch/command.hpp"
#include "launch/describe/described_command.hpp"
#include "launch/version.hpp"

namespace triptych {

void add_describe(CLI::App& app, Action& action) {
  auto form = std::make_shared<std::string>();
  CLI::App* sub = app.add_subcommand("describe", "Print the man page, or what a shell completes");
  sub->group("");
  sub->add_option("form", *form, "What to print")
      ->required()
      ->check(one_of({"man", "bash", "zsh", "fish"}))
      ->type_name("man|bash|zsh|fish");
  sub->callback([&app, form, &action] {
    action = [&app, form] {
      const auto commands = described_commands(app);
      fmt::print("{}", *form == "man"    ? man_page(commands, program_version())
                       : *form == "bash" ? bash_completion(commands)
                       : *form == "zsh"  ? zsh_completion(commands)
                                         : fish_completion(commands));
      return 0;
    };
  });
}

}  // namespace triptych
