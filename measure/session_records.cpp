#include "measure/session_records.hpp"

#include "base/error.hpp"

#include <algorithm>

namespace triptych {

using nlohmann::json;

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SocketRecord, name, bytes, messages, deltas, delta_body_bytes, delta_ids)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FrameRecord, number, frame_ms, occlusion_representation_ms,
                                   hardware_cull_ms, render_ms, network_ms, waiting_ms, camera_to_image_ms,
                                   cut_drawables, drawn_triangles, tests, added, removed, level_changes,
                                   visible_count, digest_mismatch, fallback, visible, picture_hash)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(GlNames, vendor, renderer, version)

std::vector<SocketRecord> sockets_of(Role self, const Mailbox& mailbox) {
  std::vector<SocketRecord> sockets;
  for (const Role peer : all_roles) {
    if (peer == self) continue;
    for (const Channel channel : all_channels) {
      const LinkFigures figures = mailbox.figures(peer, channel);
      sockets.push_back(
          {.name = fmt::format("{} to {}, {}", role_name(self), role_name(peer), channel_name(channel)),
           .bytes = figures.bytes_sent,
           .messages = figures.messages_sent,
           .deltas = figures.deltas_sent,
           .delta_body_bytes = figures.delta_body_bytes_sent,
           .delta_ids = figures.delta_ids_sent});
    }
  }
  return sockets;
}

void add_sockets(std::vector<SocketRecord>& sum, const std::vector<SocketRecord>& more) {
  for (const SocketRecord& socket : more) {
    const auto known =
        std::find_if(sum.begin(), sum.end(), [&](const auto& other) { return other.name == socket.name; });
    if (known == sum.end()) {
      sum.push_back(socket);
      continue;
    }
    for (const auto figure : {&SocketRecord::bytes, &SocketRecord::messages, &SocketRecord::deltas,
                              &SocketRecord::delta_body_bytes, &SocketRecord::delta_ids}) {
      (*known).*figure += socket.*figure;
    }
  }
}

json to_json(const FrameRecord& record) { return json(record); }

FrameRecord frame_record_from_json(const json& document, const std::string& place) {
  try {
    return document.get<FrameRecord>();
  } catch (const json::exception& error) {
    fail(place, "is no frame's record: {}", error.what());
  }
}

json to_json(const RoleRecord& record) {
  return {
      {"sockets", record.sockets}, {"frames", record.frames}, {"gl", record.gl}, {"raster", record.raster}};
}

RoleRecord role_record_from_json(const json& document, const std::string& place) {
  try {
    return {document.at("sockets").get<std::vector<SocketRecord>>(),
            document.at("frames").get<std::vector<FrameRecord>>(), document.at("gl").get<GlNames>(),
            document.at("raster").get<std::string>()};
  } catch (const json::exception& error) {
    fail(place, "is no role's record: {}", error.what());
  }
}

}  // namespace triptych
