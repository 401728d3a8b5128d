// Which of several surfaces in one plane shows: decided when a pack is built, so that it does not change with
// the eye.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace triptych {

/// The layer of a triangle: 0 where nothing of another colour lies in its plane with it, 1 for the uppermost,
/// 2 for what that lies on, and so on. Devices draw each a little behind the one on it
/// (visibility/layer_offset.hpp).
inline constexpr uint32_t max_layer = 15;

/// What Skeleton::effects calls it where there are any.
inline constexpr const char* layers_effect = "layers in a plane";

inline bool has_layers(const std::vector<std::string>& effects) {
  return std::find(effects.begin(), effects.end(), layers_effect) != effects.end();
}

}  // namespace triptych
