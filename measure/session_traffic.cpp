#include "measure/session_traffic.hpp"

#include "protocol/wire.hpp"

#include <algorithm>

namespace triptych {

using nlohmann::json;

FormulaBytes::FormulaBytes(double ids_per_frame) {
  constexpr double header = 50, ids_per_packet = 100, id = 4, camera_parameters = 72;
  ids_to_one_receiver = ids_per_frame * (id + header / ids_per_packet / 2);
  camera = camera_parameters + header;
}

namespace {

/// The bytes of a socket by the formula: switch nodes are HC in every other frame.
double formula_of(Role from, Role to, Channel channel, const FormulaBytes& formula) {
  if (channel == Channel::nodes) return from == Role::render ? 0 : formula.ids_to_one_receiver / 2;
  return from == Role::render && to != Role::render ? formula.camera : 0;
}

double formula_to(Role receiver, const FormulaBytes& formula) {
  return formula.camera +
         (receiver == Role::render ? formula.ids_to_one_receiver : formula.ids_to_one_receiver / 2);
}

double share(double part, double whole) { return whole > 0 ? part / whole : 0; }

}  // namespace

json traffic_json(const std::vector<RoleRecord>& roles) {
  const std::vector<FrameRecord>& frames = roles.front().frames;
  const double count = std::max<double>(1, static_cast<double>(frames.size()));
  double changed = 0, visible = 0;
  for (const FrameRecord& frame : frames) {
    changed += static_cast<double>(frame.added + frame.removed);
    visible += static_cast<double>(frame.visible_count);
  }
  const FormulaBytes formula(changed / count), whole_sets(visible / count);
  json sockets = json::array(), receivers = json::array();
  double total = 0, kernel_total = 0, ids = 0, id_bytes = 0, delta_bytes = 0;
  uint64_t retransmissions = 0;
  for (const Role to : all_roles) {
    double received = 0;
    for (size_t from = 0; from < roles.size(); ++from) {
      for (const SocketRecord& socket : roles[from].sockets) {
        for (const Channel channel : all_channels) {
          if (socket.name != socket_name(all_roles[from], to, channel)) continue;
          const auto bytes = static_cast<double>(socket.bytes);
          received += bytes;
          kernel_total += static_cast<double>(socket.kernel_bytes);
          retransmissions += socket.retransmissions;
          ids += static_cast<double>(socket.delta_ids);
          id_bytes += static_cast<double>(socket.delta_body_bytes);
          delta_bytes += static_cast<double>(socket.delta_body_bytes + socket.deltas * header_bytes);
          sockets.push_back({{"socket", socket.name},
                             {"bytes_per_frame", bytes / count},
                             {"formula_bytes_per_frame", formula_of(all_roles[from], to, channel, formula)},
                             {"messages_per_frame", static_cast<double>(socket.messages) / count},
                             {"kernel_bytes_per_frame", static_cast<double>(socket.kernel_bytes) / count},
                             {"retransmissions", socket.retransmissions},
                             {"round_trip_ms", socket.round_trip_ms},
                             {"least_round_trip_ms", socket.least_round_trip_ms}});
        }
      }
    }
    total += received;
    receivers.push_back({{"receiver", role_name(to)},
                         {"bytes_per_frame", received / count},
                         {"formula_bytes_per_frame", formula_to(to, formula)}});
  }
  return {{"sockets", sockets},
          {"receivers", receivers},
          {"bytes_per_frame", total / count},
          {"formula_bytes_per_frame", formula.total()},
          {"formula_bytes_per_frame_whole_sets", whole_sets.total()},
          {"kernel_bytes_per_frame", kernel_total / count},
          {"retransmissions", retransmissions},
          {"share_of_formula", share(total / count, formula.total())},
          {"share_of_formula_whole_sets", share(total / count, whole_sets.total())},
          {"share_of_4_bytes_per_id",
           {{"bodies", share(id_bytes, 4 * ids)}, {"bodies_and_headers", share(delta_bytes, 4 * ids)}}}};
}

}  // namespace triptych
