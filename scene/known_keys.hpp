// Keys of the JSON that people write: one that is misspelt must not read as one that is not there.
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
      fail(place, "\"{}\" is not known here", key);
  }
}

}  // namespace triptych
