#include "report/accuracy_series.hpp"

#include <algorithm>
#include <fmt/core.h>

namespace triptych {

using nlohmann::json;

std::string series_name(const json& row, const json& rows) {
  std::string name = row["strategy"].get<std::string>();
  if (!row["min_pixels"].is_null()) name += fmt::format(" {}", row["min_pixels"].get<uint32_t>());
  for (const char* key : {"device", "size", "pack"}) {
    bool differs = false;
    for (const json& other : rows) differs = differs || other[key] != row[key];
    if (differs) name += ", " + row[key].get<std::string>();
  }
  const bool differs = std::any_of(rows.begin(), rows.end(),
                                   [&](const json& other) { return other["samples"] != row["samples"]; });
  const auto samples = row["samples"].get<uint32_t>();
  if (differs) name += fmt::format(", {} sample{} a pixel", samples, samples == 1 ? "" : "s");
  return name;
}

}  // namespace triptych
