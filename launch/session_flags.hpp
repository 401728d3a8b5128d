// The flags of commands that start a session.
#pragma once

#include "launch/command.hpp"
#include "session/session_run.hpp"

namespace triptych {

/// --timeout and --gather of a render node.
void add_waiting_flags(CLI::App& command, double& timeout_ms, double& gather_s);
/// --connect-timeout of all roles.
void add_connect_timeout_flag(CLI::App& command, double& connect_timeout_s);

/// --until-told, for commands that have --loop.
void add_until_told_flag(CLI::App& command, bool& until_told);

/// --loop, --rate, --port, --batch, --timeout, --gather, --connect-timeout, --restarts, --hosts, --key-file,
/// --insecure, --record, --timeline and the picture flags, beside add_run_flags().
void add_session_flags(CLI::App& command, SessionOptions& options);

}  // namespace triptych
