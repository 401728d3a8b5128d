#include "measure/session_report.hpp"

#include "measure/frame_series.hpp"
#include "measure/json.hpp"
#include "measure/session_faults.hpp"
#include "measure/session_traffic.hpp"

#include <algorithm>

namespace triptych {

using nlohmann::json;

double formula_bits_per_second(double ids_per_frame, double frames_per_second) {
  return 8 * FormulaBytes(ids_per_frame).total() * frames_per_second;
}

namespace {

struct Delta {
  double added = 0, removed = 0, level_changes = 0, set = 0;
};

Delta sum_deltas(const std::vector<FrameRecord>& frames) {
  Delta sum;
  for (const FrameRecord& frame : frames) {
    sum.added += static_cast<double>(frame.added);
    sum.removed += static_cast<double>(frame.removed);
    sum.set += static_cast<double>(frame.visible_count);
    sum.level_changes += static_cast<double>(frame.level_changes);
  }
  return sum;
}

json stages_json(const std::vector<FrameRecord>& frames) {
  return {{"occlusion_representation",
           distribution_json(frames, [](const auto& r) { return r.occlusion_representation_ms; })},
          {"hardware_cull", distribution_json(frames, [](const auto& r) { return r.hardware_cull_ms; })},
          {"render", distribution_json(frames, [](const auto& r) { return r.render_ms; })},
          {"network", distribution_json(frames, [](const auto& r) { return r.network_ms; })},
          {"waiting", distribution_json(frames, [](const auto& r) { return r.waiting_ms; })}};
}

/// camera_to_image_ms of the frames with known parts, as consecutive parts, and the remainder: time between
/// the parts, and errors of the clocks.
json latency_json(const std::vector<FrameRecord>& frames) {
  std::vector<FrameRecord> known;
  for (const FrameRecord& frame : frames) {
    if (frame.latency_known) known.push_back(frame);
  }
  const auto remainder = [](const FrameRecord& r) {
    return r.camera_to_image_ms - r.occlusion_representation_ms - r.hardware_cull_ms - r.latency_network_ms -
           r.latency_render_ms - r.latency_waiting_ms;
  };
  return {{"frames", known.size()},
          {"whole", distribution_json(known, [](const auto& r) { return r.camera_to_image_ms; })},
          {"occlusion_representation",
           distribution_json(known, [](const auto& r) { return r.occlusion_representation_ms; })},
          {"hardware_cull", distribution_json(known, [](const auto& r) { return r.hardware_cull_ms; })},
          {"network", distribution_json(known, [](const auto& r) { return r.latency_network_ms; })},
          {"render", distribution_json(known, [](const auto& r) { return r.latency_render_ms; })},
          {"waiting", distribution_json(known, [](const auto& r) { return r.latency_waiting_ms; })},
          {"remainder", distribution_json(known, remainder)}};
}

/// A prediction, not a measurement: the stages of the one-process run were timed one at a time with all
/// cores, as on three machines. The switch nodes take turns, so HC and OR of one frame are counted one after
/// the other although OR starts while HC is still sending; the render node works in parallel.
double predicted_fps(const std::vector<FrameRecord>& one_process) {
  std::vector<double> cycles;
  for (const FrameRecord& frame : one_process) {
    cycles.push_back(std::max(frame.render_ms, frame.hardware_cull_ms + frame.occlusion_representation_ms));
  }
  const double cycle = distribution(cycles).p50;
  return cycle > 0 ? 1000 / cycle : 0;
}

double delta_body_bytes_per_id(const std::vector<RoleRecord>& roles) {
  uint64_t bytes = 0, ids = 0;
  for (const RoleRecord& role : roles) {
    for (const SocketRecord& socket : role.sockets) {
      bytes += socket.delta_body_bytes;
      ids += socket.delta_ids;
    }
  }
  return ids ? static_cast<double>(bytes) / static_cast<double>(ids) : 0.0;
}

}  // namespace

json delta_json(const std::vector<RoleRecord>& roles) {
  const std::vector<FrameRecord>& frames = roles.front().frames;
  const Delta sum = sum_deltas(frames);
  const double count = std::max<double>(1, static_cast<double>(frames.size()));
  return {{"added_mean", sum.added / count},
          {"removed_mean", sum.removed / count},
          {"level_changes_mean", sum.level_changes / count},
          {"saved_percent", sum.set > 0 ? 100 * (1 - (sum.added + sum.removed) / sum.set) : 0.0},
          {"body_bytes_per_id", delta_body_bytes_per_id(roles)}};
}

json batch_json(size_t packet_ids, const std::vector<RoleRecord>& roles) {
  const std::vector<FrameRecord>& frames = roles.front().frames;
  uint64_t bytes = 0, packets = 0;
  for (const RoleRecord& role : roles) {
    for (const SocketRecord& socket : role.sockets) {
      bytes += socket.bytes;
      packets += socket.deltas;
    }
  }
  const double count = std::max<double>(1, static_cast<double>(frames.size()));
  constexpr double receivers = 2;
  return {
      {"batch", packet_ids},
      {"bytes_per_frame", static_cast<double>(bytes) / count},
      {"packets_per_frame", static_cast<double>(packets) / receivers / count},
      {"delta_body_bytes_per_id", delta_body_bytes_per_id(roles)},
      {"camera_to_image_ms", distribution_json(frames, [](const auto& r) { return r.camera_to_image_ms; })},
      {"frame_ms", distribution_json(frames, [](const auto& r) { return r.frame_ms; })}};
}

json session_report(const Pack& pack, const SessionMeasurement& measurement) {
  const std::vector<FrameRecord>& frames = measurement.roles.front().frames;
  const double count = std::max<double>(1, static_cast<double>(frames.size()));
  double seconds = 0;
  uint64_t mismatches = 0, fallback_frames = 0, total_bytes = 0;
  for (const FrameRecord& frame : frames) {
    seconds += frame.frame_ms / 1000;
    mismatches += frame.digest_mismatch;
    fallback_frames += frame.fallback;
  }
  json sockets = json::object(), raster = json::array();
  for (const RoleRecord& role : measurement.roles) {
    raster.push_back(role.raster);
    for (const SocketRecord& socket : role.sockets) {
      sockets[socket.name] = static_cast<double>(socket.bytes) / count;
      total_bytes += socket.bytes;
    }
  }
  const Delta sum = sum_deltas(frames);
  const double frames_per_second = seconds > 0 ? static_cast<double>(frames.size()) / seconds : 0;
  const View view = measurement.requests.empty() ? View{} : measurement.requests.front().state.view;
  json report = {
      {"frames", frames.size()},
      {"size", fmt::format("{}x{}", view.width, view.height)},
      {"pixel_error", measurement.requests.empty() ? 0.0 : measurement.requests.front().state.pixel_error},
      {"triangles", pack.skeleton().placed_triangles},
      {"drawables", pack.skeleton().drawables.size()},
      {"frame_ms", distribution_json(frames, [](const auto& r) { return r.frame_ms; })},
      {"stages_ms", stages_json(frames)},
      {"camera_to_image_ms", distribution_json(frames, [](const auto& r) { return r.camera_to_image_ms; })},
      {"latency_ms", latency_json(frames)},
      {"clocks", clocks_json(measurement.roles.front())},
      {"traffic", traffic_json(measurement.roles)},
      {"visible", distribution_json(frames, [](const auto& r) { return r.visible_count; })},
      {"cut", distribution_json(frames, [](const auto& r) { return r.cut_drawables; })},
      {"tests", distribution_json(frames, [](const auto& r) { return r.tests; })},
      {"drawn_triangles", distribution_json(frames, [](const auto& r) { return r.drawn_triangles; })},
      {"delta", delta_json(measurement.roles)},
      {"bytes_per_frame", sockets},
      {"mbit_per_s",
       {{"measured", seconds > 0 ? static_cast<double>(total_bytes) * 8 / seconds / 1e6 : 0.0},
        {"formula", formula_bits_per_second((sum.added + sum.removed) / count, frames_per_second) / 1e6}}},
      {"culling_efficiency", measurement.session.culling_efficiency()},
      {"identical_frames", measurement.session.identical_frames},
      {"frames_compared", measurement.session.frames_compared},
      {"different_frames", measurement.session.different},
      {"missing_drawables", measurement.session.missing_drawables},
      {"digest_mismatches", mismatches},
      {"fallback_frames", fallback_frames},
      {"faults", faults_json(frames)},
      {"predicted_fps_three_machines", predicted_fps(measurement.one_process)},
      {"one_process",
       {{"frame_ms", distribution_json(measurement.one_process, [](const auto& r) { return r.frame_ms; })},
        {"stages_ms", stages_json(measurement.one_process)},
        {"identical_frames", measurement.fallback.identical_frames},
        {"frames_compared", measurement.fallback.frames_compared},
        {"culling_efficiency", measurement.fallback.culling_efficiency()},
        {"series", frame_series(measurement.one_process)}}},
      {"series", frame_series(frames)},
      {"raster", raster}};
  add_device(report, measurement.roles.front().device);
  return report;
}

}  // namespace triptych
