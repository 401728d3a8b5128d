// Starts the three roles on this machine, waits for them, and gathers what they recorded.
#pragma once

#include "launch/command.hpp"
#include "measure/session_records.hpp"

#include <sys/types.h>

namespace triptych {

struct SessionOptions {
  RunOptions run;
  std::filesystem::path output;    ///< folder for pictures; none where empty
  std::filesystem::path timeline;  ///< file for the trace of all stages; none where empty
  std::filesystem::path record;    ///< folder for the roles' recordings; none where empty
  size_t loop = 1;
  double rate = 0;
  uint16_t port = 0;  ///< the render node's; switch node 0 takes the next one. 0: any free ones
  bool hash = false;
};

struct SessionOutcome {
  std::vector<std::pair<std::string, pid_t>> roles;  ///< "render", "switch 0", "switch 1"
  std::vector<RoleRecord> records;                   ///< in the order of roles; empty where it was stopped
  bool stopped = false;                              ///< by a signal, in good order
};

/// --loop, --rate, --port, --record, --timeline and the run flags.
void add_session_flags(CLI::App& command, SessionOptions& options);

/// Error that names the role which failed first and why; no process is left then.
SessionOutcome run_session(const SessionOptions& options);

}  // namespace triptych
