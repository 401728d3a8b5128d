// Checks the keys of JSON files that people write, so that a misspelt key is not taken for a missing one.
#pragma once

#include "base/error.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

namespace triptych {

/// Error (place) that names a key of the object that is not among the known ones. "comment" always is.
inline void expect_known_keys(const nlohmann::json& object, const std::vector<std::string_view>& known,
                              const std::string& place) {
  for (const auto& [key, value] : object.items()) {
    if (key != "comment" && std::find(known.begin(), known.end(), key) == known.end())
      fail(place, "\"{}\" is not known here; check its spelling", key);
  }
}

}  // namespace triptych
