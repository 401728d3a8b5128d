#include "measure/accuracy/holes.hpp"

#include "measure/pixel_rays.hpp"

#include <algorithm>

namespace triptych {

PixelMask find_holes(std::span<const SurfacePixel> reference, std::span<const SurfacePixel> shown, int width,
                     int height, int radius) {
  PixelMask holes(width, height);
  // How many background pixels the reference has below and left of each corner.
  const auto across = static_cast<size_t>(width) + 1;
  std::vector<uint32_t> sums(across * (static_cast<size_t>(height) + 1), 0);
  const auto sum = [&](int x, int y) -> uint32_t& {
    return sums[static_cast<size_t>(y) * across + static_cast<size_t>(x)];
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const size_t at = static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
      sum(x + 1, y + 1) = sum(x, y + 1) + sum(x + 1, y) - sum(x, y) + (reference[at].background() ? 1 : 0);
    }
  }
  for (int y = radius; y < height - radius; ++y) {
    for (int x = radius; x < width - radius; ++x) {
      const size_t at = static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
      if (!shown[at].background()) continue;
      const int left = x - radius, right = x + radius + 1, bottom = y - radius, top = y + radius + 1;
      const uint32_t background = sum(right, top) - sum(left, top) - sum(right, bottom) + sum(left, bottom);
      holes.at(x, y) = background == 0;
    }
  }
  return holes;
}

uint64_t take_out_slits(const PackSurfaces& surfaces, const FrameView& view,
                        std::span<const SurfacePixel> shown, PixelMask& holes) {
  constexpr int beside = 2;  // pixels
  const PixelRays rays(view);
  uint64_t taken = 0;
  std::vector<DrawableId> around;
  for (int y = 0; y < holes.height; ++y) {
    for (int x = 0; x < holes.width; ++x) {
      if (holes.at(x, y) == 0) continue;
      around.clear();
      for (int row = std::max(y - beside, 0); row <= std::min(y + beside, holes.height - 1); ++row) {
        for (int column = std::max(x - beside, 0); column <= std::min(x + beside, holes.width - 1);
             ++column) {
          const SurfacePixel& pixel = shown[static_cast<size_t>(row) * static_cast<size_t>(holes.width) +
                                            static_cast<size_t>(column)];
          if (!pixel.background() && std::count(around.begin(), around.end(), pixel.drawable) == 0)
            around.push_back(pixel.drawable);
        }
      }
      const bool slit = std::any_of(around.begin(), around.end(),
                                    [&](DrawableId id) { return rays.hit(surfaces, id, x, y).has_value(); });
      if (!slit) continue;
      holes.at(x, y) = 0;
      ++taken;
    }
  }
  return taken;
}

}  // namespace triptych
