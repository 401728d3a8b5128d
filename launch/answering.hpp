// Subcommands whose exit code is an answer: 0 yes, 1 no, and 2 an error, as of grep(1) and diff(1).
#pragma once

#include "launch/command.hpp"

namespace triptych {

/// failed: set to the exit code of errors, where the subcommand is chosen.
void add_diff(CLI::App& app, Action& action, int& failed);
void add_find(CLI::App& app, Action& action, int& failed);

}  // namespace triptych
