// From candidates to triangles that can be filled, a vector of them at a time: what set_up() and slack() in
// raster/triangle.cpp compute, operation by operation. Included once by the file of each instruction set.
#pragma once

#include "raster/simd/depth_planes.hpp"
#include "raster/simd/kernels.hpp"
#include "raster/simd/piece_limits.hpp"
#include "raster/simd/pixel_ranges.hpp"
#include "raster/simd/vector.hpp"

namespace triptych {
namespace {

/// Where triangles are so small, products of two sides and a half are below 2³⁰.
[[gnu::always_inline]] inline Ints are_small(const Corners& a, const Corners& b, const Corners& c) {
  return (most(a.x, b.x, c.x) - least(a.x, b.x, c.x) < 1 << 13) &
         (most(a.y, b.y, c.y) - least(a.y, b.y, c.y) < 1 << 16);
}

/// From one corner of each triangle to the next, counter-clockwise: at the first of its pixels, as
/// FillTriangle::edge.
struct Edges {
  Ints at, step_x, step_y;
  [[gnu::always_inline]] Edges(Ints from_x, Ints from_y, Ints to_x, Ints to_y, Ints left, Ints bottom)
      : step_x(from_y - to_y), step_y(to_x - from_x) {
    const Ints own = (step_x > 0) | ((step_x == 0) & (step_y < 0));
    at = (step_y * (bottom * 256 + 128 - from_y) + step_x * (left * 256 + 128 - from_x) - 1 - own) >> 8;
  }
};

/// A vector of triangles. Edges are those of small ones.
struct Prepared {
  Edges edges[3];
  PixelRanges columns, rows;
  Ints first_x, first_y, slot;
  Floats z, low, high;
  DepthPlanes plane;

  [[gnu::always_inline]] Ints depths(Ints x, Ints y) const {
    const Ints dx = x * 256 + (128 - first_x), dy = y * 256 + (128 - first_y);
    const Floats depth = (z + plane.slope_y * to_float(dy)) + plane.slope_x * to_float(dx);
    return bits_of(select(depth < low, low, select(depth > high, high, depth)));
  }
  /// Their pixel in that column and row, counted from their first ones.
  [[gnu::always_inline]] Ints cover(int32_t right, int32_t up) const {
    Ints outside = {};
    for (const Edges& edge : edges) outside |= edge.at + edge.step_x * right + edge.step_y * up;
    return (outside >= 0) & (columns.first + right <= columns.last) & (rows.first + up <= rows.last);
  }
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
                                            const PreciseSlopes& slopes, const Corners& second,
                                            const Corners& third, SetUpResult& result) {
  for (uint32_t rest = wanted; rest != 0; rest &= rest - 1) {
    const int32_t i = __builtin_ctz(rest);
    FillTriangle& made = result.wide[result.wide_count++];
    made.left = triangles.columns.first[i];
    made.right = triangles.columns.last[i];
    made.bottom = triangles.rows.first[i];
    made.top = triangles.rows.last[i];
    const int32_t x[3] = {triangles.first_x[i], second.x[i], third.x[i]},
                  y[3] = {triangles.first_y[i], second.y[i], third.y[i]};
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
  static constexpr int32_t beyond = 1 << 20;                      // of any picture
  Ints lowest = splat(beyond), depth_of_highest = splat(beyond);  ///< counted down from `beyond`

  [[gnu::always_inline]] void add(const PixelRanges& rows, Ints which) {
    lowest = lesser(lowest, select(which, rows.first, splat(beyond)));
    depth_of_highest = lesser(depth_of_highest, select(which, beyond - rows.last, splat(beyond)));
  }
  int32_t first() const { return least_of(lowest); }
  int32_t last() const { return beyond - least_of(depth_of_highest); }
};

/// One vector of triangles, at `part` of a block.
struct SetUpStep {
  const SetUpTerms& terms;
  SetUpResult& result;
  RowsOfAll rows, rows_of_block;
  uint32_t held = 0;  ///< of the block

  [[gnu::always_inline]] Ints corner(const uint32_t* of_triangles, Ints triangle) const {
    return gather(reinterpret_cast<const int32_t*>(of_triangles), triangle);
  }
  [[gnu::always_inline]] Ints layered(Ints triangle) const {
    Ints layer = {};
    if (terms.layers == nullptr) return layer;
    for (int32_t i = 0; i < lanes; ++i) layer[i] = terms.layers[triangle[i]];
    return layer != 0;
  }

  [[gnu::always_inline]] void make(Ints triangle, Ints there, int32_t part, NarrowTriangles& block) {
    const Ints vertices = corner(terms.corners.a, triangle);
    const Corners a = corners_at(terms.points, vertices),
                  b = corners_at(terms.points, corner(terms.corners.b, triangle)),
                  c = corners_at(terms.points, corner(terms.corners.c, triangle));
    const Areas area(a, b, c);
    const Ints forward = area.rounded > 0,
               outside = (a.x == outside_x) | (b.x == outside_x) | (c.x == outside_x);
    const Ints drawn = there & (outside | (area.rounded != 0));
    const Corners second = {select(forward, b.x, c.x), select(forward, b.y, c.y), {}},
                  third = {select(forward, c.x, b.x), select(forward, c.y, b.y), {}};
    const PixelRanges columns(least(a.x, b.x, c.x), most(a.x, b.x, c.x), terms.width),
        up(least(a.y, b.y, c.y), most(a.y, b.y, c.y), terms.height);
    Prepared made = {.edges = {{a.x, a.y, second.x, second.y, columns.first, up.first},
                               {second.x, second.y, third.x, third.y, columns.first, up.first},
                               {third.x, third.y, a.x, a.y, columns.first, up.first}},
                     .columns = columns,
                     .rows = up,
                     .first_x = a.x,
                     .first_y = a.y,
                     .slot = triangle + static_cast<int32_t>(terms.first_slot),
                     .z = a.depth,
                     .low = lesser(lesser(a.depth, b.depth), c.depth),
                     .high = greater(greater(a.depth, b.depth), c.depth),
                     .plane = {}};
    const Ints small = drawn & ~outside & are_small(a, b, c) & (columns.last - columns.first < lanes);
    const Ints tiny = small & (columns.last - columns.first < 2) & (up.last - up.first < 2);
    Ints open = drawn;
    if (any(tiny)) open &= ~tiny | cover_any(made);
    if (!any(open)) return;
    made.plane = depth_planes(a, b, c, area.rounded, made.high);
    const Ints single = open & ~outside & ~layered(triangle);
    const Ints precise = single & ~(made.plane.error <= max_float_error * made.low);
    PreciseSlopes slopes;
    if (any(precise)) slopes = precise_planes(a, b, c, area, precise, made.high, made.plane.error);
    const PieceLimits limits(terms, vertices);
    const Ints ready =
        single & (lesser(lesser(limits.slack(a), limits.slack(b)), limits.slack(c)) >= made.plane.error);
    for (uint32_t rest = bits(open & ~ready); rest != 0; rest &= rest - 1)
      result.rest[result.rest_count++] = static_cast<uint32_t>(triangle[__builtin_ctz(rest)]);
    if (!any(ready)) return;
    rows.add(up, ready);
    const Ints plain = ready & small & ~precise;
    if (any(plain & tiny)) add_fragments(made, plain & tiny, result);
    const Ints narrow = plain & ~tiny;
    if (any(narrow)) {
      held |= bits(narrow) << part;
      rows_of_block.add(up, narrow);
      put(made, part, block);
    }
    if (any(ready & ~plain)) add_wide(made, bits(ready & ~plain), precise, slopes, second, third, result);
  }
};

void set_up(const SetUpTerms& terms, const uint32_t* candidates, int32_t count, SetUpResult& result) {
  result.block_count = result.fragment_count = result.wide_count = result.rest_count = 0;
  SetUpStep step{.terms = terms, .result = result, .rows = {}, .rows_of_block = {}};
  for (int32_t from = 0; from < count; from += NarrowTriangles::count) {
    NarrowTriangles& block = result.blocks[result.block_count];
    step.held = 0;
    step.rows_of_block = {};
    for (int32_t part = 0; part < NarrowTriangles::count && from + part < count; part += lanes) {
      const Ints there = lane_numbers < count - from - part;
      const Ints first = splat(static_cast<int32_t>(candidates[from + part]));
      step.make(select(there, load(candidates + from + part), first), there, part, block);
    }
    if (step.held == 0) continue;
    block.held = step.held;
    block.lowest_row = step.rows_of_block.first();
    block.highest_row = step.rows_of_block.last();
    ++result.block_count;
  }
  result.lowest_row = step.rows.first();
  result.highest_row = step.rows.last();
}

}  // namespace
}  // namespace triptych
