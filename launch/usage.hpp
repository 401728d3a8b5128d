// What is wrong with a command line, in the program's own words.
#pragma once

#include <CLI/CLI.hpp>
#include <set>
#include <string>
#include <vector>

namespace triptych {

/// A command line as far as it can be understood before it is parsed.
struct WordsRead {
  CLI::App* command = nullptr;         ///< the innermost subcommand that is named
  size_t after_command = 0;            ///< the index of the word behind its name
  std::set<const CLI::Option*> given;  ///< its options
  std::string complaint;  ///< of the first word that is no flag or subcommand; empty if there is none
};

/// Looks for a flag or subcommand that is not known: CLI11 would complain of a missing one first. `words` are
/// those behind the program's name.
WordsRead read_words(CLI::App& app, const std::vector<std::string>& words);

/// The program and the subcommands of the command line, as typed.
std::string command_name(const CLI::App& command);

/// The long flags of a command, without dashes.
std::vector<std::string> flags_of(const CLI::App& command);

/// The parser's complaint in our words.
std::string in_our_words(const CLI::ParseError& error);

}  // namespace triptych
