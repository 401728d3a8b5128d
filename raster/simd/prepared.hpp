// Triangles whose corners are in the window, a vector of them: their edges, and
// what of them is kept in which form. Included once by the file of each
// instruction set.
#pragma once

#include "raster/simd/depth_planes.hpp"
#include "raster/simd/kernels.hpp"
#include "raster/simd/pixel_ranges.hpp"
#include "raster/simd/vector.hpp"

namespace triptych {
namespace {

/// Where triangles are so small, products of two sides and a half are below
/// 2³⁰.
[[gnu::always_inline]] inline Ints are_small(const Corners& a, const Corners& b, const Corners& c) {
  return (most(a.x, b.x, c.x) - least(a.x, b.x, c.x) < 1 << 13) &
         (most(a.y, b.y, c.y) - least(a.y, b.y, c.y) < 1 << 16);
}

/// From one corner of each triangle to the next, counter-clockwise: at the
/// first of its pixels, as FillTriangle::edge.
struct Edges {
  Ints at, step_x, step_y;
  [[gnu::always_inline]] Edges(Ints from_x, Ints from_y, Ints to_x, Ints to_y, Ints left, Ints bottom)
      : step_x(from_y - to_y), step_y(to_x - from_x) {
    const Ints own = (step_x > 0) | ((step_x == 0) & (step_y < 0));
    at = (step_y * (bottom * 256 + 128 - from_y) + step_x * (left * 256 + 128 - from_x) - 1 - own) >> 8;
  }
};

/// A vector of triangles. Edges are right of small ones.
struct Prepared {
  Edges edges[3];
  PixelRanges columns, rows;
  Ints first_x, first_y, slot;
  Floats z, low, high;
  DepthPlanes plane = {};
  Corners second, third;  ///< counter-clockwise from the first, without depths

  [[gnu::always_inline]] Prepared(const Corners& a, const Corners& b, const Corners& c, Ints forward,
                                  Ints of_slot, const SetUpTerms& terms)
      : Prepared(a, b, c, Corners{select(forward, b.x, c.x), select(forward, b.y, c.y), Floats{}},
                 Corners{select(forward, c.x, b.x), select(forward, c.y, b.y), Floats{}},
                 PixelRanges(least(a.x, b.x, c.x), most(a.x, b.x, c.x), terms.width),
                 PixelRanges(least(a.y, b.y, c.y), most(a.y, b.y, c.y), terms.height), of_slot) {}

  [[gnu::always_inline]] Ints depths(Ints x, Ints y) const {
    const Ints dx = x * 256 + (128 - first_x), dy = y * 256 + (128 - first_y);
    const Floats depth = (z + plane.slope_y * to_float(dy)) + plane.slope_x * to_float(dx);
    return bits_of(select(depth < low, low, select(depth > high, high, depth)));
  }
  [[gnu::always_inline]] Ints are_no_wider(int32_t width) const {
    return columns.last - columns.first < width;
  }
  [[gnu::always_inline]] Ints are_no_higher(int32_t height) const { return rows.last - rows.first < height; }
  /// Their pixel in that column and row, counted from their first ones.
  [[gnu::always_inline]] Ints cover(int32_t right, int32_t up) const {
    Ints outside = {};
    for (const Edges& edge : edges) outside |= edge.at + edge.step_x * right + edge.step_y * up;
    return (outside >= 0) & (columns.first + right <= columns.last) & (rows.first + up <= rows.last);
  }

 private:
  [[gnu::always_inline]] Prepared(const Corners& a, const Corners& b, const Corners& c, const Corners& next,
                                  const Corners& last, const PixelRanges& across, const PixelRanges& up,
                                  Ints of_slot)
      : edges{{a.x, a.y, next.x, next.y, across.first, up.first},
              {next.x, next.y, last.x, last.y, across.first, up.first},
              {last.x, last.y, a.x, a.y, across.first, up.first}},
        columns(across),
        rows(up),
        first_x(a.x),
        first_y(a.y),
        slot(of_slot),
        z(a.depth),
        low(lesser(lesser(a.depth, b.depth), c.depth)),
        high(greater(greater(a.depth, b.depth), c.depth)),
        second(next),
        third(last) {}
};

/// Of triangles in no more than 2 × 2 pixels those that cover any.
[[gnu::always_inline]] inline Ints cover_any(const Prepared& triangles) {
  return triangles.cover(0, 0) | triangles.cover(1, 0) | triangles.cover(0, 1) | triangles.cover(1, 1);
}

[[gnu::always_inline]] inline void add_fragments(const Prepared& triangles, Ints wanted,
                                                 SetUpResult& result) {
  for (int32_t up = 0; up < 2; ++up) {
    for (int32_t right = 0; right < 2; ++right) {
      const Ints covered = wanted & triangles.cover(right, up);
      if (!any(covered)) continue;
      const Ints x = triangles.columns.first + right, y = triangles.rows.first + up,
                 depth = triangles.depths(x, y);
      const uint32_t some = bits(covered & (depth > 0));
      const int32_t end = result.fragment_count;
      store_some(some, (y << 16) + x, result.fragments.places + end);
      store_some(some, depth, result.fragments.depths + end);
      store_some(some, triangles.slot, result.fragments.slots + end);
      result.fragment_count = end + __builtin_popcount(some);
    }
  }
}

/// Into those places of a block from `start` on.
[[gnu::always_inline]] inline void put(const Prepared& triangles, int32_t start, NarrowTriangles& block) {
  for (int k = 0; k < 3; ++k) {
    store(triangles.edges[k].at, block.edge[k] + start);
    store(triangles.edges[k].step_x, block.step_x[k] + start);
    store(triangles.edges[k].step_y, block.step_y[k] + start);
  }
  store(triangles.columns.first, block.left + start);
  store(triangles.columns.last, block.right + start);
  store(triangles.rows.first, block.bottom + start);
  store(triangles.rows.last, block.top + start);
  store(triangles.first_x, block.first_x + start);
  store(triangles.first_y, block.first_y + start);
  store(bits_of(triangles.z), block.z + start);
  store(bits_of(triangles.plane.slope_x), block.slope_x + start);
  store(bits_of(triangles.plane.slope_y), block.slope_y + start);
  store(bits_of(triangles.low), block.low + start);
  store(bits_of(triangles.high), block.high + start);
  store(triangles.slot, block.slot + start);
}

/// The others, one by one: what does not fit 32 bits is computed again.
[[gnu::always_inline]] inline void add_wide(const Prepared& triangles, uint32_t wanted, Ints precise,
                                            const PreciseSlopes& slopes, SetUpResult& result) {
  for (uint32_t rest = wanted; rest != 0; rest &= rest - 1) {
    const int32_t i = __builtin_ctz(rest);
    FillTriangle& made = result.wide[result.wide_count++];
    made.left = triangles.columns.first[i];
    made.right = triangles.columns.last[i];
    made.bottom = triangles.rows.first[i];
    made.top = triangles.rows.last[i];
    const int32_t x[3] = {triangles.first_x[i], triangles.second.x[i], triangles.third.x[i]},
                  y[3] = {triangles.first_y[i], triangles.second.y[i], triangles.third.y[i]};
    for (int k = 0; k < 3; ++k) {
      const Edges& edge = triangles.edges[k];
      made.step_x[k] = edge.step_x[i];
      made.step_y[k] = edge.step_y[i];
      const bool own = made.step_x[k] > 0 || (made.step_x[k] == 0 && made.step_y[k] < 0);
      made.edge[k] = (int64_t{made.step_y[k]} * (made.bottom * 256 + 128 - y[k]) +
                      int64_t{made.step_x[k]} * (made.left * 256 + 128 - x[k]) - (own ? 0 : 1)) >>
                     8;
    }
    made.first_x = x[0];
    made.first_y = y[0];
    made.z = triangles.z[i];
    made.slope_x = triangles.plane.slope_x[i];
    made.slope_y = triangles.plane.slope_y[i];
    made.low = triangles.low[i];
    made.high = triangles.high[i];
    made.slot = static_cast<uint32_t>(triangles.slot[i]);
    made.precise = precise[i] != 0;
    made.precise_x = made.precise ? slopes.x[i] : 0;
    made.precise_y = made.precise ? slopes.y[i] : 0;
    made.limit = nullptr;
    made.sides = nullptr;
    made.cut = 0;
  }
}

/// The rows that any of some triangles has pixels in.
struct RowsOfAll {
  static constexpr int32_t beyond = 1 << 20;  // of any picture
  Ints lowest = splat(beyond),
       depth_of_highest = splat(beyond);  ///< counted down from `beyond`

  [[gnu::always_inline]] void add(const PixelRanges& rows, Ints which) {
    lowest = lesser(lowest, select(which, rows.first, splat(beyond)));
    depth_of_highest = lesser(depth_of_highest, select(which, beyond - rows.last, splat(beyond)));
  }
  int32_t first() const { return least_of(lowest); }
  int32_t last() const { return beyond - least_of(depth_of_highest); }
};

}  // namespace
}  // namespace triptych
