// Which of several surfaces in one plane shows: decided when a pack is built, so that it does not change with
// the eye.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace triptych {

/// Of a triangle: so many surfaces of other colours lie on it in its plane, at most. Devices move it behind
/// them (visibility/layer_offset.hpp).
inline constexpr uint32_t max_layers_above = 15;

/// What Skeleton::effects calls it where there are any.
inline constexpr const char* layers_effect = "layers in a plane";

inline bool has_layers(const std::vector<std::string>& effects) {
  return std::find(effects.begin(), effects.end(), layers_effect) != effects.end();
}

}  // namespace triptych
