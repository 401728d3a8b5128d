// What an X server shows.
#pragma once

#include <cstdint>
#include <vector>

namespace triptych::test {

/// RGBA, bottom row first, of the window of that size on DISPLAY; empty where there is none.
std::vector<uint8_t> pixels_of_window(int width, int height);

}  // namespace triptych::test
