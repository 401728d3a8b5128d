// The subcommand `diff`, whose errors end with another exit code than those of the others.
#pragma once

#include "launch/command.hpp"

namespace triptych {

/// failed: set to the exit code of errors, where this subcommand is chosen.
void add_diff(CLI::App& app, Action& action, int& failed);

}  // namespace triptych
