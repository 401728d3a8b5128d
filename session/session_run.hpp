// Starts the three roles, here or on other machines, waits for them, and gathers what they recorded.
#pragma once

#include "measure/session_records.hpp"
#include "session/first_viewpoint.hpp"
#include "session/run_options.hpp"
#include "visibility/strategies.hpp"

#include <sys/types.h>

namespace triptych {

struct SessionOptions {
  RunOptions run;
  std::filesystem::path output;    ///< folder for pictures; empty: none are written
  std::filesystem::path timeline;  ///< file for the trace of all stages; empty: none is written
  std::filesystem::path record;    ///< folder for the roles' recordings; empty: none are written
  /// Ids per packet; a list where a command sweeps.
  std::vector<size_t> batches = {CullOptions{}.packet_ids};
  StrategyKind strategy = StrategyKind::occlusion;  ///< an exact one
  size_t loop = 1;
  double rate = 0;
  double timeout_ms = 500;         ///< after which the render node draws by itself
  double gather_s = 0;             ///< the first frame waits so long for switch nodes
  double connect_timeout_s = 20;   ///< of a search; then roles say who is missing, and go on searching
  size_t restarts = 10;            ///< how often each role is started again after it was killed
  std::filesystem::path hosts;     ///< the hosts file; empty: all roles run on this machine
  std::filesystem::path key_file;  ///< of a session on this machine; empty: no encryption
  bool insecure = false;
  uint16_t port = 0;  ///< the render node's; switch node 0 takes the next one. 0: any free ones
  bool hash = false;
  bool window = false;       ///< a person at the render node moves the camera
  FirstViewpoint viewpoint;  ///< where the person begins
  bool until_told = false;   ///< the path is played until a signal comes
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
  HiddenName hidden;     ///< at the beginning
  bool stopped = false;  ///< ended properly by a signal
  int exit_code = 0;     ///< 128 and the signal, where that came before the session was done
};

/// Starts the roles and supervises them. A render node that is killed by a signal is started again at the
/// first frame that has no record and no picture yet; Error where it fails or is killed too often. A switch
/// node is started again however it ends, after a pause where that was an error; whatever becomes of it, the
/// session goes on. All of them open the pack that the session began with, and play the path as it was then.
/// No process is left running.
SessionOutcome run_session(const SessionOptions& options);

}  // namespace triptych
