// The pictures of an accuracy report on its page.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace triptych {

/// HTML of report["strip"]: one frame at each pixel error.
std::string accuracy_strip(const nlohmann::json& report);
/// HTML of report["patches"]: the worst places, each with the settings that show it.
std::string accuracy_places(const nlohmann::json& report);

}  // namespace triptych
