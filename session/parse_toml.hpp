// TOML that people wrote: parsed, and in plain words what is wrong with it.
#pragma once

#include <string>
#include <string_view>
#include <toml++/toml.h>

namespace triptych {

/// The table in the text. Error (place, line, column) if it is no TOML: what is expected there, and what was
/// found.
toml::table parse_toml(std::string_view text, const std::string& place);

}  // namespace triptych
