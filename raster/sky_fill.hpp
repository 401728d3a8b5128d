// The sky where nothing else is (visibility/sky_look.hpp).
#pragma once

#include "raster/shading_counts.hpp"
#include "raster/visibility_buffer.hpp"
#include "visibility/sky_look.hpp"

#include <cstdint>
#include <optional>
#include <span>

namespace triptych {

/// The sky of a view that shows one.
inline std::optional<SkyLook> sky_shown(const FrameView& view) {
  return shows_sky(view.state) ? std::optional<SkyLook>(view) : std::nullopt;
}

/// Gives the pixels of a row that show nothing the sky's colours.
inline void fill_sky(const SkyLook& look, std::span<const uint32_t> depths, int32_t y, Rgba* row,
                     ShadingCounts& counts) {
  const TimedShading timed(counts.sky_ms);
  uint64_t filled = 0;
  for (size_t x = 0; x < depths.size(); ++x) {
    if (depths[x] != 0) continue;
    row[x] = look.at(static_cast<int32_t>(x), y);
    ++filled;
  }
  counts.sky_pixels += filled;
}

}  // namespace triptych
