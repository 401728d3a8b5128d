// Connected patches of pixels that something is wrong with.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace triptych {

/// Pixels of a picture: 1 where something is so.
struct PixelMask {
  PixelMask(int w, int h) : width(w), height(h), pixels(static_cast<size_t>(w) * static_cast<size_t>(h), 0) {}
  uint8_t& at(int x, int y) {
    return pixels[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
  }
  bool at(int x, int y) const {
    return pixels[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)] != 0;
  }

  int width, height;
  std::vector<uint8_t> pixels;
};

struct Patches {
  uint64_t pixels = 0;   ///< that are set
  uint64_t largest = 0;  ///< pixels of the largest connected patch; neighbours share a side or a corner
  /// The box of that patch: from left, bottom up to, not including, right, top.
  int left = 0, bottom = 0, right = 0, top = 0;
  int x = 0, y = 0;  ///< a pixel of it
};
Patches find_patches(PixelMask mask);

}  // namespace triptych
