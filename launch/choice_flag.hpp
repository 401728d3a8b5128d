// Flags whose value is one of a few words.
#pragma once

#include "base/near_words.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace triptych {

/// A check that accepts only these words; the error lists them, the help text does not.
inline CLI::Validator one_of(const std::vector<std::string>& words) {
  return CLI::Validator(
      [words](const std::string& word) {
        if (std::find(words.begin(), words.end(), word) != words.end()) return std::string();
        return "\"" + word + "\" is none of " + CLI::detail::join(words, ", ") + did_you_mean(word, words);
      },
      "");
}

/// A flag that sets `target` to what the word on the command line names; any other word is a usage error that
/// lists them, as does the help text: a|b|c. `target` must live as long as the command.
template <typename Target, typename Value>
CLI::Option* add_choice_flag(CLI::App& command, const std::string& flag, Target& target,
                             const std::map<std::string, Value>& names, const std::string& help) {
  std::vector<std::string> words;
  for (const auto& [word, value] : names) words.push_back(word);
  return command
      .add_option_function<std::string>(
          flag, [&target, names](const std::string& word) { target = names.at(word); }, help)
      ->check(one_of(words))
      ->type_name(CLI::detail::join(words, "|"));
}

}  // namespace triptych
