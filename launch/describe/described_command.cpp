#include "launch/describe/described_command.hpp"

#include "launch/named_files.hpp"

#include <algorithm>

namespace triptych {

namespace {

/// "a|b|c" are choices, and so are "a,b|c"; "FILE.json" and "WxH" are not.
std::vector<std::string> choices_in(const std::string& value) {
  std::vector<std::string> words;
  if (value.find('|') != std::string::npos) words = CLI::detail::split(value, '|');
  if (std::any_of(words.begin(), words.end(),
                  [](const std::string& word) { return word.find(',') != std::string::npos; }))
    words = CLI::detail::split(CLI::detail::join(words, ","), ',');
  return words;
}

DescribedFlag described(const CLI::Option& option) {
  DescribedFlag flag;
  flag.positional = option.get_positional();
  for (const std::string& name : option.get_snames()) flag.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) flag.names.push_back("--" + name);
  if (flag.positional) flag.names = {option.get_name()};
  flag.description = option.get_description();
  flag.required = option.get_required();
  if (option.get_items_expected_max() == 0) return flag;
  flag.value = option.get_type_name();
  flag.otherwise = option.get_default_str();
  flag.choices = choices_in(flag.value);
  flag.is_list = !flag.choices.empty() && flag.value.find(',') != std::string::npos;
  flag.names_file = names_files(option);
  return flag;
}

void add_commands(const CLI::App& command, std::vector<std::string> path,
                  std::vector<DescribedCommand>& into) {
  DescribedCommand described_command{.path = path,
                                     .description = command.get_description(),
                                     .footer = command.get_footer(),
                                     .flags = {},
                                     .subcommands = {}};
  for (const CLI::Option* option : command.get_options())
    described_command.flags.push_back(described(*option));
  std::vector<const CLI::App*> below;
  for (const CLI::App* sub : command.get_subcommands([](const CLI::App*) { return true; })) {
    if (sub->get_group().empty()) continue;
    below.push_back(sub);
    described_command.subcommands.push_back(sub->get_name());
  }
  into.push_back(std::move(described_command));
  for (const CLI::App* sub : below) {
    path.push_back(sub->get_name());
    add_commands(*sub, path, into);
    path.pop_back();
  }
}

}  // namespace

std::string DescribedCommand::words() const { return CLI::detail::join(path, " "); }

std::vector<DescribedCommand> described_commands(const CLI::App& app) {
  std::vector<DescribedCommand> commands;
  add_commands(app, {}, commands);
  return commands;
}

}  // namespace triptych
