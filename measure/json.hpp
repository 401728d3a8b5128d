// Reports as JSON.
#pragma once

#include "base/distribution.hpp"
#include "scene/import_report.hpp"
#include "visibility/device.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace triptych {

/// {"mean", "p50", "p95", "p99", "max"}.
nlohmann::json to_json(const Distribution& distribution);

/// {"dropped_triangles", "welded_vertices", "repaired_edges", "stuck_groups", "warnings"}.
nlohmann::json to_json(const ImportReport& report);

/// Adds "device" (gl or cpu) and, where it is used, "gl" {"vendor", "renderer", "version"}.
void add_device(nlohmann::json& report, const DeviceNames& device);
/// {"vendor", "renderer", "version"} as OpenGL says them.
nlohmann::json opengl_json(const DeviceNames& names);

/// The distribution of what `value` gives for each record.
template <typename Record, typename Value>
nlohmann::json distribution_json(const std::vector<Record>& records, Value value) {
  std::vector<double> values;
  for (const Record& record : records) values.push_back(static_cast<double>(value(record)));
  return to_json(distribution(values));
}

/// Its text as valid JSON: bytes that are not UTF-8, as file names may contain, become U+FFFD. On one line if
/// there is no indent.
std::string json_text(const nlohmann::json& value, int indent = -1);

/// From here on what this process prints to standard output goes to standard error, and the object that is
/// written to
/// "-" to standard output. Error if that cannot be.
void give_standard_output_to_json();

/// Writes one object, atomically. An empty path writes nothing; "-" is standard output, as
/// give_standard_output_to_json() says.
void write_json(const std::filesystem::path& file, const nlohmann::json& object);

}  // namespace triptych
