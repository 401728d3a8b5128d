// From candidates to triangles that can be filled, a vector of them at a time:
// what set_up() and slack() in raster/triangle.cpp compute, operation by
// operation. Included once by the file of each instruction set.
#pragma once

#include "raster/simd/depth_planes.hpp"
#include "raster/simd/kernels.hpp"
#include "raster/simd/layered.hpp"
#include "raster/simd/piece_limits.hpp"
#include "raster/simd/prepared.hpp"
#include "raster/simd/vector.hpp"

namespace triptych {
namespace {

/// One vector of triangles, at `part` of a block.
struct SetUpStep {
  const SetUpTerms& terms;
  SetUpResult& result;
  RowsOfAll rows, rows_of_block;
  uint32_t held = 0;  ///< of the block

  [[gnu::always_inline]] void make(Ints triangle, Ints there, int32_t part, NarrowTriangles& block) {
    const Ints vertices = vertices_of(terms.corners.a, triangle);
    const Corners a = corners_at(terms.points, vertices),
                  b = corners_at(terms.points, vertices_of(terms.corners.b, triangle)),
                  c = corners_at(terms.points, vertices_of(terms.corners.c, triangle));
    const Areas area(a, b, c);
    const Ints outside = (a.x == outside_x) | (b.x == outside_x) | (c.x == outside_x);
    Prepared made(a, b, c, area.rounded > 0, triangle + static_cast<int32_t>(terms.first_slot), terms);
    Ints open = there & (outside | (area.rounded != 0));
    const Ints small = open & ~outside & are_small(a, b, c) & made.are_no_wider(lanes);
    const Ints tiny = small & made.are_no_wider(2) & made.are_no_higher(2);
    if (any(tiny)) open &= ~tiny | cover_any(made);
    if (!any(open)) return;
    const Ints layered = open & ~outside & (layers_of(terms, triangle) != 0),
               single = open & ~outside & ~layered;
    made.plane = depth_planes(a, b, c, area.rounded, made.high);
    const Ints precise = single & ~(made.plane.error <= max_float_error * made.low);
    PreciseSlopes slopes;
    if (any(precise)) slopes = precise_planes(a, b, c, area, precise, made.high, made.plane.error);
    const Ints ready = single & (PieceLimits(terms, vertices).least_slack(a, b, c) >= made.plane.error);
    append(triangle, layered, result.layered, result.layered_count);
    append(triangle, open & ~ready & ~layered, result.rest, result.rest_count);
    if (!any(ready)) return;
    rows.add(made.rows, ready);
    const Ints plain = ready & small & ~precise;
    if (any(plain & tiny)) add_fragments(made, plain & tiny, result);
    const Ints narrow = plain & ~tiny;
    if (any(narrow)) {
      held |= bits(narrow) << part;
      rows_of_block.add(made.rows, narrow);
      put(made, part, block);
    }
    if (any(ready & ~plain)) add_wide(made, bits(ready & ~plain), precise, slopes, result);
  }
};

void set_up(const SetUpTerms& terms, const uint32_t* candidates, int32_t count, SetUpResult& result) {
  result.block_count = result.fragment_count = result.wide_count = result.rest_count = result.layered_count =
      0;
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
  for (int32_t from = 0; from < result.layered_count; from += lanes)
    make_layered(terms, from, result, step.rows);
  result.lowest_row = step.rows.first();
  result.highest_row = step.rows.last();
}

}  // namespace
}  // namespace triptych
