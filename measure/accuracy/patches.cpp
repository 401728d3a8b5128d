#include "measure/accuracy/patches.hpp"

#include <algorithm>
#include <utility>

namespace triptych {

namespace {

/// Takes the patch that holds this pixel out of the mask.
Patches take_patch(PixelMask& mask, int x, int y, std::vector<std::pair<int, int>>& open) {
  Patches patch{.left = x, .bottom = y, .right = x + 1, .top = y + 1, .x = x, .y = y};
  open.assign(1, {x, y});
  mask.at(x, y) = 0;
  while (!open.empty()) {
    const auto [column, row] = open.back();
    open.pop_back();
    ++patch.pixels;
    patch.left = std::min(patch.left, column);
    patch.right = std::max(patch.right, column + 1);
    patch.bottom = std::min(patch.bottom, row);
    patch.top = std::max(patch.top, row + 1);
    for (int up = std::max(row - 1, 0); up <= std::min(row + 1, mask.height - 1); ++up) {
      for (int across = std::max(column - 1, 0); across <= std::min(column + 1, mask.width - 1); ++across) {
        if (std::exchange(mask.at(across, up), uint8_t{0}) != 0) open.emplace_back(across, up);
      }
    }
  }
  patch.largest = patch.pixels;
  return patch;
}

}  // namespace

Patches find_patches(PixelMask mask) {
  Patches found;
  std::vector<std::pair<int, int>> open;
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) {
      if (mask.at(x, y) == 0) continue;
      Patches patch = take_patch(mask, x, y, open);
      const uint64_t pixels = found.pixels + patch.pixels;
      if (patch.largest > found.largest) found = patch;
      found.pixels = pixels;
    }
  }
  return found;
}

}  // namespace triptych
