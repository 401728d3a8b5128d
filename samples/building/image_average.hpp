// The average colour of a JPEG or PNG image: what remains of a texture where colours are per material.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string_view>

namespace triptych {

/// Mean of the pixels in linear light (0 to 1), weighted by alpha where there is one; nothing if the bytes
/// are no JPEG or PNG that can be decoded.
std::optional<glm::dvec3> average_colour(std::string_view bytes);

/// One channel from sRGB's curve (IEC 61966-2-1) to linear light, both 0 to 1.
double linear_from_srgb(double value);

}  // namespace triptych
