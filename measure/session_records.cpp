#include "measure/session_records.hpp"

#include "base/error.hpp"
#include "base/parse_json.hpp"
#include "base/timeline.hpp"

#include <algorithm>

namespace triptych {

using nlohmann::json;

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SocketRecord, name, bytes, messages, deltas, delta_body_bytes, delta_ids,
                                   kernel_bytes, retransmissions, round_trip_ms, least_round_trip_ms)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SteeredFrame, target_ms, asked_pixel_error, pixel_error, aim_ms,
                                   predicted_ms, cost_ms, wall_ms, undisturbed, in_reach)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FrameRecord, number, frame_ms, occlusion_representation_ms,
                                   hardware_cull_ms, render_ms, network_ms, waiting_ms, camera_to_image_ms,
                                   latency_known, latency_waiting_ms, latency_network_ms, latency_render_ms,
                                   cut_drawables, drawn_triangles, tests, added, removed, level_changes,
                                   visible_count, digest_mismatch, fallback, lost, visible, pixel_error,
                                   raised_for_memory, owed_drawables, left_out_drawables, redrawn, gets_finer,
                                   picture_hash, steered)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(TextureUse, cap, bytes, peak_bytes, hits, misses, evicted, read_bytes,
                                   decoded_bytes, uploaded_bytes, coarser_views, over_cap_views)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(GeometryUse, cap, bytes, peak_bytes, view_bytes, hits, loaded_chunks,
                                   evicted_chunks, left_out, no_room, reloaded_chunks, read_bytes,
                                   uploaded_bytes, wait_ms, textures)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ReadAheadUse, read_ahead, in_time, late, taken, foreseen_read,
                                   foreseen_taken, reads, dropped, bytes, peak_bytes, open)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(DrawingMemory, geometry, read_ahead)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(DeviceNames, vendor, renderer, version)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(StageSpan, stage, frame, begin_ms, end_ms)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ProcessTimeline, process, spans, lost)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Backlog, messages, bytes)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PeerClock, peer, ahead_ms, uncertainty_ms)

std::string socket_name(Role from, Role to, Channel channel) {
  return fmt::format("{} to {}, {}", role_name(from), role_name(to), channel_name(channel));
}

ProcessTimeline own_timeline(const std::string& process) {
  ProcessTimeline timeline{.process = process, .spans = {}, .lost = timeline_spans_lost()};
  for (const TimelineSpan& span : timeline_spans()) {
    timeline.spans.push_back({span.stage, span.frame, span.begin_ms, span.end_ms});
  }
  return timeline;
}

std::vector<SocketRecord> sockets_of(Role self, const Mailbox& mailbox) {
  std::vector<SocketRecord> sockets;
  for (const Role peer : all_roles) {
    if (peer == self) continue;
    for (const Channel channel : all_channels) {
      const LinkFigures figures = mailbox.figures(peer, channel);
      const TcpFigures kernel = mailbox.kernel_figures(peer, channel);
      sockets.push_back({.name = socket_name(self, peer, channel),
                         .bytes = figures.bytes_sent,
                         .messages = figures.messages_sent,
                         .deltas = figures.deltas_sent,
                         .delta_body_bytes = figures.delta_body_bytes_sent,
                         .delta_ids = figures.delta_ids_sent,
                         .kernel_bytes = kernel.bytes_sent,
                         .retransmissions = kernel.retransmissions,
                         .round_trip_ms = kernel.round_trip_ms,
                         .least_round_trip_ms = kernel.min_round_trip_ms});
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
                              &SocketRecord::delta_body_bytes, &SocketRecord::delta_ids,
                              &SocketRecord::kernel_bytes, &SocketRecord::retransmissions}) {
      (*known).*figure += socket.*figure;
    }
    known->round_trip_ms = socket.round_trip_ms;
    known->least_round_trip_ms = std::min(known->least_round_trip_ms, socket.least_round_trip_ms);
  }
}

void add_backlog(Backlog& most, const Backlog& more) {
  most.messages = std::max(most.messages, more.messages);
  most.bytes = std::max(most.bytes, more.bytes);
}

json to_json(const FrameRecord& record) { return json(record); }

FrameRecord frame_record_from_json(const json& document, const std::string& place) {
  try {
    return document.get<FrameRecord>();
  } catch (const json::exception& error) {
    fail(place, "is not the record of a frame: {}", in_words(error));
  }
}

json clocks_json(const RoleRecord& record) { return record.clocks; }

json to_json(const RoleRecord& record) {
  return {{"role_record", role_record_version},
          {"sockets", record.sockets},
          {"frames", record.frames},
          {"device", record.device},
          {"raster", record.raster},
          {"timeline", record.timeline},
          {"clocks", record.clocks},
          {"most_waiting", record.max_backlog},
          {"cost_coefficients", record.cost_coefficients},
          {"memory", record.memory},
          {"peak_rss_bytes", record.peak_rss_bytes}};
}

/// Counts of a later process of the same role, and the larger of peaks.
static void add_memory(DrawingMemory& sum, const DrawingMemory& more) {
  GeometryUse& geometry = sum.geometry;
  geometry.cap = more.geometry.cap;
  geometry.peak_bytes = std::max(geometry.peak_bytes, more.geometry.peak_bytes);
  for (const auto count : {&GeometryUse::hits, &GeometryUse::loaded_chunks, &GeometryUse::evicted_chunks,
                           &GeometryUse::left_out, &GeometryUse::no_room, &GeometryUse::reloaded_chunks,
                           &GeometryUse::read_bytes, &GeometryUse::uploaded_bytes})
    geometry.*count += more.geometry.*count;
  geometry.wait_ms += more.geometry.wait_ms;
  TextureUse& textures = geometry.textures;
  textures.cap = more.geometry.textures.cap;
  textures.peak_bytes = std::max(textures.peak_bytes, more.geometry.textures.peak_bytes);
  for (const auto count : {&TextureUse::hits, &TextureUse::misses, &TextureUse::evicted,
                           &TextureUse::read_bytes, &TextureUse::decoded_bytes, &TextureUse::uploaded_bytes,
                           &TextureUse::coarser_views, &TextureUse::over_cap_views})
    textures.*count += more.geometry.textures.*count;
  ReadAheadUse& ahead = sum.read_ahead;
  ahead.peak_bytes = std::max(ahead.peak_bytes, more.read_ahead.peak_bytes);
  for (const auto count : {&ReadAheadUse::read_ahead, &ReadAheadUse::in_time, &ReadAheadUse::late,
                           &ReadAheadUse::taken, &ReadAheadUse::foreseen_read, &ReadAheadUse::foreseen_taken,
                           &ReadAheadUse::reads, &ReadAheadUse::dropped})
    ahead.*count += more.read_ahead.*count;
}

void add_record(RoleRecord& sum, const RoleRecord& record) {
  add_sockets(sum.sockets, record.sockets);
  add_backlog(sum.max_backlog, record.max_backlog);
  sum.device = record.device;
  sum.raster = record.raster;
  sum.timeline.process = record.timeline.process;
  sum.timeline.spans.insert(sum.timeline.spans.end(), record.timeline.spans.begin(),
                            record.timeline.spans.end());
  sum.timeline.lost += record.timeline.lost;
  if (!record.clocks.empty()) sum.clocks = record.clocks;
  sum.cost_coefficients = record.cost_coefficients;
  add_memory(sum.memory, record.memory);
  sum.peak_rss_bytes = std::max(sum.peak_rss_bytes, record.peak_rss_bytes);
}

RoleRecord role_record_from_json(const json& document, const std::string& place) {
  if (!document.is_object()) fail(place, "is not the record of a role");
  // Records of the first builds have no version.
  const json version = document.value("role_record", json(0));
  if (version != role_record_version) {
    fail(place,
         "is the record of a role of another build of the program: its version is {}, this one needs {}",
         version.dump(), role_record_version);
  }
  try {
    return {document.at("sockets").get<std::vector<SocketRecord>>(),
            document.at("frames").get<std::vector<FrameRecord>>(),
            document.at("device").get<DeviceNames>(),
            document.at("raster").get<std::string>(),
            document.at("timeline").get<ProcessTimeline>(),
            document.at("clocks").get<std::vector<PeerClock>>(),
            document.at("most_waiting").get<Backlog>(),
            document.at("cost_coefficients").get<CostCoefficients>(),
            document.at("memory").get<DrawingMemory>(),
            document.at("peak_rss_bytes").get<uint64_t>()};
  } catch (const json::exception& error) {
    fail(place, "is not the record of a role: {}", in_words(error));
  }
}

}  // namespace triptych
