#include "report/accuracy_series.hpp"

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
  return name;
}

}  // namespace triptych
