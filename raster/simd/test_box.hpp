// Box tests: whole tiles first, a vector of them at a time, then pixels.
// Included once by the file of each instruction set.
#pragma once

#include "raster/simd/kernels.hpp"
#include "raster/simd/vector.hpp"

namespace triptych {
namespace {

/// Pixel centres, from −1 to 1.
[[gnu::always_inline]] inline Floats centres(Ints pixel, int32_t size) {
  return (2.0f * to_float(pixel) + 1.0f) / static_cast<float>(size) - 1.0f;
}
[[gnu::always_inline]] inline float centre_of(int32_t pixel, int32_t size) {
  return (2 * static_cast<float>(pixel) + 1) / static_cast<float>(size) - 1;
}
[[gnu::always_inline]] inline Floats plane_at(const PlaneTerms& plane, const Floats& x, float y) {
  return plane.x * x + plane.y * y + plane.offset;
}
[[gnu::always_inline]] inline Ints passes(const BoxTerms& box, Floats depth, Floats there) {
  return box.strict ? depth > there : depth >= there;
}

/// Counts down `missing`, pixels that have yet to show; whether none is missing
/// any more.
[[gnu::always_inline]] inline bool test_pixels(const BoxTerms& box, const PixelRectangle& pixels,
                                               const DepthSource& source, int32_t& missing) {
  for (int32_t start = pixels.left; start <= pixels.right; start += lanes) {
    const Ints column = lane_numbers + start;
    const Ints wanted = column <= pixels.right;
    const Floats x = centres(column, source.width);
    for (int32_t row = pixels.bottom; row <= pixels.top; ++row) {
      const Floats there = (Floats)load(source.depths + int64_t{row} * source.stride + start);
      const float y = centre_of(row, source.height);
      Floats depth = plane_at(box.planes[0], x, y);
      for (int i = 1; i < 4; ++i) {
        const Floats other = plane_at(box.planes[i], x, y);
        depth = select(other < depth, other, depth);
      }
      Ints shows = wanted & passes(box, depth, there) & (depth >= 0);
      if (!any(shows)) continue;
      for (int i = 0; i < 4; ++i) shows &= plane_at(box.cuts[i], x, y) >= 0;
      missing -= __builtin_popcount(bits(shows));
      if (missing <= 0) return true;
    }
  }
  return false;
}

/// A part of a row of tiles: those that may not be passed over are looked at
/// pixel by pixel. Sums and products of floats are monotone in each operand:
/// what a plane gives at the outermost centres of a tile bounds, to the bit,
/// what it gives between.
[[gnu::always_inline]] inline bool test_tile_row(const BoxTerms& box, const PixelRectangle& pixels,
                                                 const DepthSource& source, int32_t& missing) {
  constexpr int32_t side = tile_side;
  const float* const tiles = source.tiles + int64_t{pixels.bottom / side} * source.columns;
  const int32_t last = pixels.right / side;
  for (int32_t first = pixels.left / side; first <= last; first += lanes) {
    const Floats there = (Floats)load(tiles + first);
    Ints open = passes(box, splat(box.planes[0].offset), there) & (lane_numbers <= last - first);
    if (!any(open)) continue;  // the level plane alone decides nearly everything
    const Ints start = (lane_numbers + first) * side, end = start + (side - 1);
    const Floats left = centres(select(start < pixels.left, splat(pixels.left), start), source.width),
                 right = centres(select(end > pixels.right, splat(pixels.right), end), source.width);
    const float bottom = centre_of(pixels.bottom, source.height), top = centre_of(pixels.top, source.height);
    const auto most = [&](const PlaneTerms& plane) __attribute__((always_inline)) {
      return plane_at(plane, plane.x > 0 ? right : left, plane.y > 0 ? top : bottom);
    };
    for (const PlaneTerms& plane : box.planes) {
      const Floats depth = most(plane);
      open &= passes(box, depth, there) & (depth >= 0);
    }
    for (const PlaneTerms& cut : box.cuts) open &= most(cut) >= 0;
    for (uint32_t rest = bits(open); rest != 0; rest &= rest - 1) {
      const int32_t from = (first + __builtin_ctz(rest)) * side, to = from + side - 1;
      const PixelRectangle inside = {greater(from, pixels.left), lesser(to, pixels.right), pixels.bottom,
                                     pixels.top};
      if (test_pixels(box, inside, source, missing)) return true;
    }
  }
  return false;
}

/// Calls test(pixels) for those parts of rows of tiles in which blocks do not
/// hide all that is this deep, until it is true; whether it was.
template <typename Test>
[[gnu::always_inline]] inline bool any_tile_row(float nearest, bool strict, const PixelRectangle& pixels,
                                                const DepthSource& source, const Test& test) {
  constexpr int32_t side = tile_side, block = block_side;
  for (int32_t y = pixels.bottom / block; y <= pixels.top / block; ++y) {
    const float* const blocks = source.blocks + int64_t{y} * source.block_columns;
    bool hidden = true;
    for (int32_t x = pixels.left / block; hidden && x <= pixels.right / block; ++x)
      hidden = strict ? !(nearest > blocks[x]) : !(nearest >= blocks[x]);
    if (hidden) continue;
    const int32_t end = lesser((y + 1) * block - 1, pixels.top);
    for (int32_t row = greater(y * block, pixels.bottom); row <= end;) {
      const int32_t row_end = lesser((row / side + 1) * side - 1, end);
      if (test(PixelRectangle{pixels.left, pixels.right, row, row_end})) return true;
      row = row_end + 1;
    }
  }
  return false;
}

bool hides(float nearest, bool strict, const PixelRectangle& pixels, const DepthSource& source) {
  constexpr int32_t side = tile_side;
  const int32_t first = pixels.left / side, last = pixels.right / side;
  return !any_tile_row(nearest, strict, pixels, source, [&](const PixelRectangle& row) {
    const float* const tiles = source.tiles + int64_t{row.bottom / side} * source.columns;
    for (int32_t x = first; x <= last; x += lanes) {
      const Floats there = (Floats)load(tiles + x);
      const Ints open = strict ? nearest > there : nearest >= there;
      if (any(open & (lane_numbers <= last - x))) return true;
    }
    return false;
  });
}

int32_t count_box(const BoxTerms& box, const PixelRectangle& pixels, const DepthSource& source,
                  int32_t enough) {
  int32_t missing = enough;
  const bool all =
      any_tile_row(box.planes[0].offset, box.strict, pixels, source,
                   [&](const PixelRectangle& row) { return test_tile_row(box, row, source, missing); });
  return all ? enough : enough - missing;
}

}  // namespace
}  // namespace triptych
