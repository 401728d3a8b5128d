// What rows of an accuracy report are called.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace triptych {

/// The setting without its pixel error, as far as rows differ in it.
std::string series_name(const nlohmann::json& row, const nlohmann::json& rows);

}  // namespace triptych
