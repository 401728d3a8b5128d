// JSON that people and other programs wrote: parsed, and in plain words what is wrong with it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace triptych {

/// The value in the text. Error (place) with json_fault() if it is no JSON.
nlohmann::json parse_json(std::string_view text, const std::string& place);

/// The first fault of a text: "line 3, column 14: is no JSON: a comma or } is expected, not "target"".
/// Columns count letters. Empty for JSON.
std::string json_fault(std::string_view text);

/// What is wrong with a value that was read as something else than it is: "it has no "frames"", "it has a
/// text where a number is expected".
std::string in_words(const nlohmann::json::exception& error);

}  // namespace triptych
