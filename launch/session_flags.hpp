// The flags of commands that start a session.
#pragma once

#include "launch/command.hpp"
#include "session/session_run.hpp"

namespace triptych {

/// --loop, --rate, --port, --batch, --timeout, --restarts, --hosts, --key-file, --insecure, --record,
/// --timeline and the picture flags, beside add_run_flags().
void add_session_flags(CLI::App& command, SessionOptions& options);

}  // namespace triptych
