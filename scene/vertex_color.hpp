// The colour of a vertex: an attribute of its own beside the position, where a model has one.
#pragma once

#include <array>
#include <cstdint>

namespace triptych {

/// Red, green, blue as displayed (sRGB), and 255; all zero where the vertex has no colour of its own.
using VertexColor = std::array<uint8_t, 4>;

/// Of the corners of a triangle.
using CornerColors = std::array<VertexColor, 3>;

inline bool is_colored(const VertexColor& color) { return color[3] != 0; }

}  // namespace triptych
