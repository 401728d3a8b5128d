// What cut surfaces look like, where a section opens something solid.
#pragma once

#include "raster/slots.hpp"
#include "visibility/pixel_sides.hpp"

#include <array>
#include <optional>

namespace triptych {

/// Caps are drawn (raster/cap_fill.hpp) in the name of the nearest back behind them, with slots of their own.
class Caps {
 public:
  /// Pixel centres lie at this sample of each pixel.
  explicit Caps(const FrameView& view, const SamplePlace& place = {});

  /// Whether it is caps that show in the triangle's name.
  static bool show(const SlotTable::Triangle& shown) { return shown.range->caps; }
  /// Where the ray of a pixel comes in; nullopt where that is the near plane.
  std::optional<PixelSides::Entry> entry(int32_t x, int32_t y) const {
    return sides_.entry(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
  }
  /// Eye space, length 1.
  const glm::vec3& normal(uint32_t side) const { return sides_.normal(side); }
  /// What a material's colour is multiplied by.
  float light(uint32_t side) const { return lights_[side]; }

 private:
  PixelSides sides_;
  std::array<float, Section::max_sides> lights_{};
};

/// Whether outsides go round clockwise under a placement.
bool mirrors(const PlacedLattice& placed);

}  // namespace triptych
