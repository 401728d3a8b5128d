// The palette of chunks whose triangles have one colour, and are opaque.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace triptych::test {

inline const std::vector<std::array<uint8_t, 4>> opaque_palette = {{0, 0, 0, 255}};

}  // namespace triptych::test
