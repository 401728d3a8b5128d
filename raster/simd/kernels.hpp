// The inner loops of the rasteriser, once for each instruction set; all of them give the same bits.
#pragma once

#include "raster/fill_triangle.hpp"

#include <cstdint>

namespace triptych {

/// What vertices of a chunk are multiplied by: PlacedLattice, ClipTerms and WindowTransform as plain numbers.
struct TransformTerms {
  float rows[3][4];
  int32_t cell[3];
  float frustum[4], depth[2];
  bool orthographic;
  float scale_x, scale_y, guard_x, guard_y;
  int32_t middle_x, middle_y;
};
struct LatticePoints {
  const int32_t *x, *y, *z;
};
/// Of each vertex: sub-pixels, reversed depth, and all bits set where it is inside of the planes that
/// triangles are clipped at. Where it is not, the others hold nothing.
struct WindowPoints {
  int32_t *x, *y;
  float* depth;
  int32_t* inside;
};

/// Rows from first to last, both included; none where first > last.
struct Rows {
  int32_t first, last;
};

/// x · X + y · Y + offset at (X, Y), in this order.
struct PlaneTerms {
  float x, y, offset;
};
/// ScreenRectangle as plain numbers, without its sides.
struct BoxTerms {
  PlaneTerms planes[4], cuts[4];
  float width, height;  ///< of the picture, pixels
  bool strict;          ///< in front of what is there, not at it
};
/// Pixels, all inclusive.
struct PixelRectangle {
  int32_t left, right, bottom, top;
};

/// Plain functions on plain data, so that their files share no code with others (docs/developing.md).
struct RasterKernels {
  int32_t min_width;  ///< of pictures, pixels; narrower ones are drawn without
  /// Transforms the first of so many vertices, as many as make whole vectors; how many these are.
  int32_t (*transform_vertices)(const TransformTerms& terms, const LatticePoints& points, int32_t count,
                                const WindowPoints& result);
  /// Fills rows first_row to last_row, both included, of a buffer of `width` pixels a row.
  void (*fill_depths)(const FillTriangle& triangle, int32_t first_row, int32_t last_row, uint32_t* words,
                      int32_t width);
  /// The same for words of a depth above a slot. Pixels of equal depth stay as they are; returns the rows
  /// that have any.
  Rows (*fill_words)(const FillTriangle& triangle, int32_t first_row, int32_t last_row, uint64_t* words,
                     int32_t width);
  /// Whether the box may show at the centre of one of these pixels.
  bool (*test_depths)(const BoxTerms& box, const uint32_t* words, int32_t width,
                      const PixelRectangle& pixels);
  bool (*test_words)(const BoxTerms& box, const uint64_t* words, int32_t width, const PixelRectangle& pixels);
};

extern const RasterKernels sse42_kernels, avx2_kernels, avx512_kernels;

}  // namespace triptych
