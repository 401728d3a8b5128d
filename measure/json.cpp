#include "measure/json.hpp"

#include "base/descriptor.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "nodes/device_choice.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <span>
#include <unistd.h>

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

namespace {
Descriptor json_output;  // the standard output that this process began with
}

void give_standard_output_to_json() {
  json_output = Descriptor(::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1));
  if (!json_output.is_open() || ::dup2(STDERR_FILENO, STDOUT_FILENO) < 0)
    fail("standard output", "{}", std::strerror(errno));
}

void write_json(const std::filesystem::path& file, const nlohmann::json& object) {
  if (file.empty()) return;
  const std::string text = json_text(object, 2) + "\n";
  if (file != "-" || !json_output.is_open()) return write_file(file, text);
  write_all(json_output.number(), std::as_bytes(std::span(text)), "standard output");
}

}  // namespace triptych
