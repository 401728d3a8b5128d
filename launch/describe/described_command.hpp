// The program's commands and flags as plain values, for its man page and for what shells complete.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace triptych {

struct DescribedFlag {
  std::vector<std::string> names;      ///< with dashes; of what the command is about, its name without any
  std::string value;                   ///< what follows it, as in --help; empty for one without a value
  std::string description, otherwise;  ///< otherwise: its default; may be empty
  std::vector<std::string> choices;    ///< the words of its value, where it takes no others
  bool is_list = false;                ///< its value may be several of the choices, with commas between them
  bool names_file = false, positional = false, required = false;
};

struct DescribedCommand {
  std::vector<std::string> path;  ///< {"measure", "session"}; empty for the program itself
  std::string description, footer;
  std::vector<DescribedFlag> flags;
  std::vector<std::string> subcommands;

  std::string words() const;  ///< "measure session"
};

/// The program and all of its commands, the outer ones first; hidden ones are left out.
std::vector<DescribedCommand> described_commands(const CLI::App& app);

/// A man page of section 1.
std::string man_page(const std::vector<DescribedCommand>& commands, const std::string& version);
/// Scripts that complete command lines in bash, zsh and fish.
std::string bash_completion(const std::vector<DescribedCommand>& commands);
std::string zsh_completion(const std::vector<DescribedCommand>& commands);
std::string fish_completion(const std::vector<DescribedCommand>& commands);

}  // namespace triptych
