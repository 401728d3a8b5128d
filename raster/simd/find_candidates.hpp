// Triangles that lie between pixel centres or beside the picture are most of
// what is drawn, and are left out here. Included once by the file of each
// instruction set.
#pragma once

#include "raster/simd/kernels.hpp"
#include "raster/simd/pixel_ranges.hpp"
#include "raster/simd/vector.hpp"

namespace triptych {
namespace {

/// Those of at most two tiles in each direction that lie strictly behind all of
/// these.
[[gnu::always_inline]] inline Ints behind_tiles(const PixelRanges& x, const PixelRanges& y, Floats nearest,
                                                Ints wanted, const DepthSource& source) {
  const Ints left = x.first / tile_side, right = x.last / tile_side, bottom = y.first / tile_side,
             top = y.last / tile_side;
  const Ints few = wanted & (right - left <= 1) & (top - bottom <= 1);
  if (!any(few)) return few;
  const auto behind = [&](Ints column, Ints row) __attribute__((always_inline)) {
    // Tile 0, which there always is, for those that are not wanted.
    const Ints index = select(few, row * source.columns + column, Ints{});
    return nearest < (Floats)gather(reinterpret_cast<const int32_t*>(source.tiles), index);
  };
  return few & behind(left, bottom) & behind(right, bottom) & behind(left, top) & behind(right, top);
}

/// Those of the lanes from triangle i on that are outward.
[[gnu::always_inline]] inline Ints are_outward(const OutwardTriangles& outward, int32_t i) {
  const uint32_t first = outward.first + static_cast<uint32_t>(i);
  uint64_t word;
  __builtin_memcpy(&word, outward.bits + first / 32, sizeof word);
  const Ints bits = splat(static_cast<int32_t>(word >> first % 32));
  return (bits >> lane_numbers & 1) != 0;
}

/// Those whose area has another sign. Differences of corners are below 2²⁴:
/// doubles hold products exactly, and floats keep the sign of a whole number.
[[gnu::always_inline]] inline Ints face_away(Ints x1, Ints y1, Ints x2, Ints y2, int32_t front) {
  const auto area = [&](bool upper) __attribute__((always_inline)) {
    return half(x1, upper) * half(y2, upper) - half(x2, upper) * half(y1, upper);
  };
  return to_float(area(false), area(true)) * splat(static_cast<float>(front)) < 0;
}

int32_t find_candidates(const WindowPoints& points, const TriangleCorners& corners, int32_t count,
                        const OutwardTriangles& outward, const DepthSource& source, uint32_t* candidates) {
  int32_t found = 0;
  for (int32_t i = 0; i < count; i += lanes) {
    const Ints a = load(corners.a + i), b = load(corners.b + i), c = load(corners.c + i);
    const Ints ax = gather(points.x, a), bx = gather(points.x, b), cx = gather(points.x, c);
    const Ints ay = gather(points.y, a), by = gather(points.y, b), cy = gather(points.y, c);
    const PixelRanges x(least(ax, bx, cx), most(ax, bx, cx), source.width),
        y(least(ay, by, cy), most(ay, by, cy), source.height);
    const Ints outside = (ax == outside_x) | (bx == outside_x) | (cx == outside_x);
    Ints wanted = x.hold_some() & y.hold_some() & ~outside & (lane_numbers < count - i);
    if (outward.front != 0) {
      const Ints checked = wanted & are_outward(outward, i);
      if (any(checked)) wanted &= ~(checked & face_away(bx - ax, by - ay, cx - ax, cy - ay, outward.front));
    }
    if (any(wanted)) {
      const auto* const depths = reinterpret_cast<const int32_t*>(points.depth);
      const Floats nearest = (Floats)most(gather(depths, a), gather(depths, b), gather(depths, c));
      wanted &= ~behind_tiles(x, y, nearest, wanted, source);
    }
    if (any(outside)) {
      const auto beyond = [](Ints corner_x, Ints corner_y) __attribute__((always_inline)) {
        return corner_y & (corner_x == outside_x);
      };
      const Ints beyond_one = beyond(ax, ay) & beyond(bx, by) & beyond(cx, cy);
      wanted |= outside & (beyond_one == 0) & (lane_numbers < count - i);
    }
    for (uint32_t rest = bits(wanted); rest != 0; rest &= rest - 1)
      candidates[found++] = static_cast<uint32_t>(i + __builtin_ctz(rest));
  }
  return found;
}

}  // namespace
}  // namespace triptych
