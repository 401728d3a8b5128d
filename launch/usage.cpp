#include "launch/usage.hpp"

#include "base/near_words.hpp"

#include <algorithm>
#include <cctype>
#include <fmt/core.h>
#include <regex>

namespace triptych {

namespace {

std::vector<std::string> subcommands_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* sub : command.get_subcommands([](const CLI::App*) { return true; })) {
    if (!sub->get_group().empty()) names.push_back(sub->get_name());
  }
  return names;
}

CLI::App* subcommand(CLI::App& command, const std::string& name) {
  for (CLI::App* sub : command.get_subcommands([](CLI::App*) { return true; })) {
    if (sub->check_name(name)) return sub;
  }
  return nullptr;
}

/// The flag that a word is, without a value that is part of it: "--size" of "--size=1x1", "-o" of
/// "-opictures". Empty for other words, "-1" among them.
std::string flag_in(const std::string& word) {
  if (word.starts_with("--")) return word.substr(0, word.find('='));
  const bool is_short =
      word.size() > 1 && word[0] == '-' && std::isalpha(static_cast<unsigned char>(word[1])) != 0;
  return is_short ? word.substr(0, 2) : "";
}

std::string unknown_flag(const CLI::App& command, const std::string& flag) {
  std::vector<std::string> known;
  for (const std::string& name : flags_of(command)) known.push_back("--" + name);
  return fmt::format("there is no flag {}{}", flag, did_you_mean(flag, known));
}

}  // namespace

std::vector<std::string> flags_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back(name);
  }
  return names;
}

WordsRead read_words(CLI::App& app, const std::vector<std::string>& words) {
  WordsRead read{.command = &app, .after_command = 0, .given = {}, .complaint = {}};
  for (size_t i = 0; i < words.size() && words[i] != "--"; ++i) {
    const std::string flag = flag_in(words[i]);
    if (flag.empty()) {
      const auto names = subcommands_of(*read.command);
      if (names.empty()) continue;  // what the command is about
      CLI::App* const sub = subcommand(*read.command, words[i]);
      if (!sub) {
        read.complaint =
            fmt::format("there is no subcommand \"{}\"{}", words[i], did_you_mean(words[i], names));
        return read;
      }
      read.command = sub;
      read.after_command = i + 1;
      continue;
    }
    const CLI::Option* const option = read.command->get_option_no_throw(flag);
    if (!option) {
      read.complaint = unknown_flag(*read.command, flag);
      return read;
    }
    read.given.insert(option);
    const bool value_in_word = words[i].size() > flag.size();
    if (!value_in_word) i += static_cast<size_t>(std::max(0, option->get_items_expected_min()));
  }
  return read;
}

std::string command_name(const CLI::App& command) {
  std::string name;
  for (const CLI::App* at = &command; at->get_parent() != nullptr; at = at->get_parent())
    name = " " + at->get_name() + name;
  return "triptych" + name;
}

std::string in_our_words(const CLI::ParseError& error) {
  const std::string said = error.what();
  std::smatch part;
  const auto is = [&](const char* pattern) { return std::regex_match(said, part, std::regex(pattern)); };
  if (is("(.+): [0-9]+ required (.*) missing"))
    return fmt::format("{} needs a value{}", part.str(1), part.length(2) > 0 ? ", " + part.str(2) : "");
  if (is("(.+): At [lL]east ([0-9]+) required but received ([0-9]+)"))
    return fmt::format("{} takes {} values at least, and is given {}", part.str(1), part.str(2), part.str(3));
  if (is("(.+): At [mM]ost ([0-9]+) required but received ([0-9]+)"))
    return fmt::format("{} takes {} value{}, and is given {}", part.str(1), part.str(2),
                       part.str(2) == "1" ? "" : "s", part.str(3));
  if (is("The following arguments? (?:was|were) not expected: (.*)"))
    return "there is no use for: " + part.str(1);
  if (is("A subcommand is required")) return "a subcommand is required";
  if (is("Could not convert: (.+) = (.*)"))
    return fmt::format("{}: \"{}\" is no value for it", part.str(1), part.str(2));
  if (is("(.+) was given a disallowed flag override")) return part.str(1) + " takes no value";
  if (is("(-[^ ]+) excludes (-[^ ]+)"))
    return fmt::format("{} and {} do not go together", part.str(1), part.str(2));
  if (is("(-[^ ]+) requires (-[^ ]+)")) return fmt::format("{} needs {} beside it", part.str(1), part.str(2));
  return said;
}

}  // namespace triptych
