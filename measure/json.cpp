#include "measure/json.hpp"

#include "base/file.hpp"
#include "nodes/device_choice.hpp"

namespace triptych {

nlohmann::json to_json(const Distribution& distribution) {
  return {{"mean", distribution.mean},
          {"p50", distribution.p50},
          {"p95", distribution.p95},
          {"p99", distribution.p99},
          {"max", distribution.max}};
}

nlohmann::json to_json(const ImportReport& report) {
  return {{"dropped_triangles", report.dropped_triangles},
          {"welded_vertices", report.welded_vertices},
          {"repaired_edges", report.repaired_edges},
          {"stuck_groups", report.stuck_groups},
          {"warnings", report.warnings}};
}

void add_device(nlohmann::json& report, const DeviceNames& device) {
  report["device"] = device_name(kind_of(device));
  if (kind_of(device) != DeviceKind::gl) return;
  report["gl"] = opengl_json(device);
}

nlohmann::json opengl_json(const DeviceNames& names) {
  return {{"vendor", names.vendor}, {"renderer", names.renderer}, {"version", names.version}};
}

std::string json_text(const nlohmann::json& value, int indent) {
  return value.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
}

void write_json(const std::filesystem::path& file, const nlohmann::json& object) {
  if (!file.empty()) write_file(file, json_text(object, 2) + "\n");
}

}  // namespace triptych
