// Starts the three roles on this machine, waits for them, and gathers what they recorded.
#pragma once

#include "measure/session_records.hpp"
#include "session/run_options.hpp"

#include <sys/types.h>

namespace triptych {

struct SessionOptions {
  RunOptions run;
  std::filesystem::path output;    ///< folder for pictures; none where empty
  std::filesystem::path timeline;  ///< file for the trace of all stages; none where empty
  std::filesystem::path record;    ///< folder for the roles' recordings; none where empty
  std::vector<size_t> batches = {CullOptions{}.packet_ids};  ///< ids a packet; a list where a command sweeps
  size_t loop = 1;
  double rate = 0;
  double timeout_ms = 500;         ///< after which the render node goes on alone
  size_t restarts = 10;            ///< of a role that is killed, each
  std::filesystem::path hosts;     ///< the file of other machines; all on this one where empty
  std::filesystem::path key_file;  ///< of a session on this machine; none where empty
  bool insecure = false;
  uint16_t port = 0;  ///< the render node's; switch node 0 takes the next one. 0: any free ones
  bool hash = false;
  bool window = false;  ///< a person at the render node gives the cameras
};

/// A process that was killed and has a successor.
struct RestartedRole {
  std::string role;  ///< "switch 0"
  pid_t pid = -1;
  std::string reason;
};

struct SessionOutcome {
  std::vector<std::pair<std::string, pid_t>> roles;  ///< "render", "switch 0", "switch 1"
  std::vector<RoleRecord> records;                   ///< render node, switch node 0, switch node 1
  std::vector<RestartedRole> restarted;
  bool stopped = false;  ///< by a signal, in good order
};

/// Starts the roles and looks after them: one that is killed by a signal is started again, a render node at
/// the first frame that has no record and no picture yet. Error that names the role which failed and why; no
/// process is left then.
SessionOutcome run_session(const SessionOptions& options);

}  // namespace triptych
