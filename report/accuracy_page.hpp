// The report of `measure accuracy` as one HTML page.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace triptych {

/// report: as accuracy_json() gives it, with "title", "command", "frames_say", and the "strip" and "patches"
/// of write_accuracy_pictures(). The page needs those pictures beside it and nothing else.
std::string accuracy_page(const nlohmann::json& report);

}  // namespace triptych
