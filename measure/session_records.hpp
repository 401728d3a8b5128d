// What the three roles of a session hand to whoever started them: JSON files, one a role.
#pragma once

#include "nodes/frame_record.hpp"
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
};

struct RoleRecord {
  std::vector<SocketRecord> sockets;  ///< what this role sent
  std::vector<FrameRecord> frames;    ///< the render node's
  GlNames gl;
  std::string raster;  ///< verdict of the role's raster certificate
};

/// What the role has sent so far, socket by socket.
std::vector<SocketRecord> sockets_of(Role self, const Mailbox& mailbox);
/// Adds figures of later connections to those of the same names.
void add_sockets(std::vector<SocketRecord>& sum, const std::vector<SocketRecord>& more);

nlohmann::json to_json(const FrameRecord& record);
/// Error (place) for JSON that is no frame's record.
FrameRecord frame_record_from_json(const nlohmann::json& json, const std::string& place);

nlohmann::json to_json(const RoleRecord& record);
/// Error (place) for JSON that is no role's record.
RoleRecord role_record_from_json(const nlohmann::json& json, const std::string& place);

}  // namespace triptych
