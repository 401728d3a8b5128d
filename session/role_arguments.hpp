// The command lines by which a session starts its roles.
#pragma once

#include "session/hosts.hpp"
#include "session/session_run.hpp"

#include <optional>
#include <string>
#include <vector>

namespace triptych {

/// What the roles of one session have in common, besides its options.
struct SessionSetup {
  uint64_t session = 0;        ///< the number that they share
  uint64_t pack_hash = 0;      ///< of the content of their packs
  std::filesystem::path path;  ///< the session's own copy of its path; empty: none
  std::filesystem::path bcf;   ///< the same of its viewpoints
  std::optional<Hosts> hosts;  ///< of a session over several machines
  const Listener* render_listener = nullptr;
  const Listener* switch_listener = nullptr;  ///< used by a session on this machine alone
  std::filesystem::path journal;              ///< of the render node's frames
  std::filesystem::path place;                ///< where the person at its window stands
};

/// `role render …`, from the first frame that is not in the journal.
std::vector<std::string> render_arguments(const SessionOptions& options, const SessionSetup& setup);

/// `role switch …`, for this machine or for its host.
std::vector<std::string> switch_arguments(const SessionOptions& options, const SessionSetup& setup,
                                          Role role);

}  // namespace triptych
