// The palette of chunks whose triangles have one colour, and are opaque.
#pragma once

#include <array>
#include <cstdint>

namespace triptych::test {

inline constexpr std::array<std::array<uint8_t, 4>, 1> opaque_palette = {{{0, 0, 0, 255}}};

}  // namespace triptych::test
