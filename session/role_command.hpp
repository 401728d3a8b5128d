// The options of `triptych role`, and the two kinds of role that it can run.
#pragma once

#include "protocol/role.hpp"
#include "session/first_viewpoint.hpp"
#include "session/run_options.hpp"
#include "visibility/strategies.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace triptych {

/// Flags of both kinds of role.
struct RoleCommand {
  Role self = Role::render;
  RunOptions run;
  std::string listen, render_address, switch_0_address;
  std::filesystem::path key_file;
  bool insecure = false, end_with_stdin = false, tell_record = false;
  bool keep_trying = false;  ///< of a switch node: also where nobody comes in time
  int listen_descriptor = -1;
  StrategyKind strategy = StrategyKind::occlusion;
  CullOptions cull;
  uint64_t session = 0;
  std::optional<uint64_t> pack_hash;  ///< what the pack's content must be
  double connect_timeout_s = 20;
  bool timeline = false, window = false;
  std::filesystem::path record;  ///< folder for the recording; none where empty
  // of the render node only
  std::filesystem::path output, journal;
  size_t loop = 1;
  double rate = 0;
  double timeout_ms = 500;
  double gather_s = 0;  ///< the first frame waits so long for switch nodes
  uint32_t begin = 0;
  bool hash = false;
  std::filesystem::path place;  ///< where the person at the window stands, for its successor; empty: not kept
  FirstViewpoint viewpoint;     ///< where that person begins
  bool until_told = false;      ///< the path is played until a signal comes, which is no interruption then
};

/// Runs a switch node until the session is over, and writes its record. Returns the exit code: that of an
/// interruption where a signal ended it. Error where it cannot go on.
int run_switch(const RoleCommand& command);

/// Runs the render node until the last frame, and writes its record. Returns the exit code: that of an
/// interruption where a signal came before the last frame. Error where it cannot go on.
int run_render(const RoleCommand& command);

}  // namespace triptych
