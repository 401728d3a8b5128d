// What the three roles of a session report to the process that started them: JSON files, one per role.
#pragma once

#include "nodes/cost_model.hpp"
#include "nodes/frame_record.hpp"
#include "nodes/inbox.hpp"
#include "nodes/memory_caps.hpp"
#include "protocol/mailbox.hpp"
#include "render/context.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace triptych {

/// One direction of one socket.
struct SocketRecord {
  std::string name;  ///< "switch node 0 to render node, nodes"
  uint64_t bytes = 0, messages = 0;
  uint64_t deltas = 0, delta_body_bytes = 0, delta_ids = 0;
  uint64_t kernel_bytes = 0, retransmissions = 0;     ///< TcpFigures of what was sent
  double round_trip_ms = 0, least_round_trip_ms = 0;  ///< of the last connection, and the least of all
};

std::string socket_name(Role from, Role to, Channel channel);

/// A stage of a frame as one process timed it, on its own steady clock.
struct StageSpan {
  std::string stage;
  uint32_t frame = 0;
  double begin_ms = 0, end_ms = 0;
};

/// What a process recorded for the timeline; no spans if none was requested.
struct ProcessTimeline {
  std::string process;  ///< "render node"
  std::vector<StageSpan> spans;
  uint64_t lost = 0;  ///< spans beyond the limit
};

/// Of the JSON of a RoleRecord: increased whenever its keys, or those of its parts, change.
constexpr int role_record_version = 6;

struct RoleRecord {
  std::vector<SocketRecord> sockets;  ///< what this role sent
  std::vector<FrameRecord> frames;    ///< the render node's
  DeviceNames device;
  std::string raster;  ///< verdict of the role's raster certificate
  ProcessTimeline timeline;
  std::vector<PeerClock> clocks;         ///< the render node's: its peers' clocks against its own
  Backlog max_backlog{};                 ///< the most that had arrived and was not used yet
  CostCoefficients cost_coefficients{};  ///< the render node's, of frames that were steered
  DrawingMemory memory{};
  uint64_t peak_rss_bytes = 0;  ///< as the kernel counts it; the largest of all its processes
};

/// What this process has recorded so far.
ProcessTimeline own_timeline(const std::string& process);

/// What the role has sent so far, socket by socket.
std::vector<SocketRecord> sockets_of(Role self, const Mailbox& mailbox);
/// Adds figures of later connections to those of the same names.
void add_sockets(std::vector<SocketRecord>& sum, const std::vector<SocketRecord>& more);

/// The larger of both, of messages and of bytes.
void add_backlog(Backlog& most, const Backlog& more);

nlohmann::json to_json(const FrameRecord& record);
/// Error (place) for JSON that is not the record of a frame.
FrameRecord frame_record_from_json(const nlohmann::json& json, const std::string& place);

/// [{"peer", "ahead_ms", "uncertainty_ms"}].
nlohmann::json clocks_json(const RoleRecord& record);

nlohmann::json to_json(const RoleRecord& record);
/// Adds what a later process of the same role recorded, except its frames.
void add_record(RoleRecord& sum, const RoleRecord& record);
/// Error (place) for JSON that is not the record of a role, or has another version, from another build of the
/// program.
RoleRecord role_record_from_json(const nlohmann::json& json, const std::string& place);

}  // namespace triptych
