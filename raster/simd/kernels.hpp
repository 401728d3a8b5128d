// The inner loops of the rasteriser, once for each instruction set; all of them
// give the same bits.
#pragma once

#include "raster/fill_triangle.hpp"

#include <cstdint>

namespace triptych {

/// What vertices of a chunk are multiplied by: PlacedLattice, ClipTerms and
/// WindowTransform as plain numbers.
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
/// Of each vertex: sub-pixels and reversed depth. Where it is not inside of the
/// planes that triangles are clipped at, x is this number, y has a bit for each
/// plane that it is beyond, and depth holds nothing.
constexpr int32_t outside_x = -(1 << 30);
struct WindowPoints {
  int32_t *x, *y;
  float* depth;
};
/// What boxes and triangles are tested against: depths as bits, the farthest
/// depths of tiles of 8 × 8 pixels, so many in a row, and of blocks of 8 × 8
/// tiles.
struct DepthSource {
  const uint32_t* depths;
  int32_t width, height, stride;
  const float* tiles;
  int32_t columns;
  const float* blocks;
  int32_t block_columns;
};
/// Indices of vertices, one of each array a triangle.
struct TriangleCorners {
  const uint32_t *a, *b, *c;
};

/// Which of the triangles may be left out where they face away: those with a
/// bit from bit `first` on, if their area has not this sign, positive where
/// corners go round counter-clockwise. None where `front` is 0.
struct OutwardTriangles {
  const uint32_t* bits;
  uint32_t first;
  int32_t front;
};

/// LayerOffset as plain numbers.
struct LayerTerms {
  float focal_x, focal_y, axis_x, axis_y, step, snapped, parallel, depth_rounding;
};

/// What triangles of a placed chunk are made from.
struct SetUpTerms {
  WindowPoints points;
  LatticePoints lattice;  ///< the same vertices before they were transformed
  const TransformTerms* transform;
  LayerTerms layer_offset;
  TriangleCorners corners;
  const uint8_t* pieces;     ///< of each vertex, index into limits
  const DepthLimit* limits;  ///< of each piece
  const uint8_t* layers;     ///< of each triangle; null if all are 0
  uint32_t first_slot;
  int32_t width, height;  ///< of the picture
};
/// The room is the caller's: for each candidate one of `wide` and of `rest`,
/// and four fragments, besides a vector of them, and for sixteen candidates a
/// block. rest: may be the candidates' own place. layered: for the kernel's own
/// use; room for each candidate, and a vector of them.
struct SetUpResult {
  NarrowTriangles* blocks;
  Fragments fragments;
  FillTriangle* wide;  ///< those that are neither narrow nor of 2 × 2 pixels at
                       ///< most, or are precise or layered
  uint32_t* rest;      ///< candidates of which nothing was made: clipped or limited ones
  uint32_t* layered;
  int32_t block_count, fragment_count, wide_count, rest_count, layered_count;
  int32_t lowest_row,
      highest_row;  ///< that any of them but the rest have pixels in
};

/// x · X + y · Y + offset at (X, Y), in this order.
struct PlaneTerms {
  float x, y, offset;
};
/// ScreenRectangle as plain numbers, without its sides.
struct BoxTerms {
  PlaneTerms planes[4], cuts[4];
  bool strict;  ///< in front of what is there, not at it
};
/// Pixels, all inclusive.
struct PixelRectangle {
  int32_t left, right, bottom, top;
};

/// What pixels become: 4 bytes each.
struct SlotColors {
  uint32_t background;
  /// Of a slot, where kept_slots[slot & kept_mask] is that slot, its colour
  /// stands in kept_colors.
  const uint32_t *kept_slots, *kept_colors;
  uint32_t kept_mask;
  /// Of any slot; may change what is kept.
  void* context;
  uint32_t (*of_slot)(void* context, uint32_t slot);
};

/// Plain functions on plain data, so that their files share no code with others
/// (docs/developing.md).
struct RasterKernels {
  /// Transforms so many vertices, and up to `lanes` − 1 after them.
  void (*transform_vertices)(const TransformTerms& terms, const LatticePoints& points, int32_t count,
                             const WindowPoints& result);
  /// Of so many triangles those that may show, or may when they are clipped:
  /// their numbers, in order, and how many these are. The others cover no pixel
  /// centre, lie behind the tiles that they are in or beyond one plane, or face
  /// away. Reads up to `lanes` − 1 triangles more, and 31 bits.
  int32_t (*find_candidates)(const WindowPoints& points, const TriangleCorners& corners, int32_t count,
                             const OutwardTriangles& outward, const DepthSource& source,
                             uint32_t* candidates);
  /// Makes what is drawn of so many candidates. Reads up to `lanes` − 1
  /// candidates more.
  void (*set_up)(const SetUpTerms& terms, const uint32_t* candidates, int32_t count, SetUpResult& result);
  /// Fills rows first_row to last_row, both included, as fill() does.
  void (*fill_narrow)(const NarrowTriangles& triangles, int32_t first_row, int32_t last_row,
                      const FillTarget& target);
  /// The same. Their tiles are marked.
  void (*fill_fragments)(const Fragments& fragments, int32_t count, int32_t first_row, int32_t last_row,
                         const FillTarget& target);
  /// Fills rows first_row to last_row, both included: some of the triangle's,
  /// and of the picture's. Tiles that it covers are up to date then, others are
  /// marked; those that hide it are left alone.
  void (*fill)(const FillTriangle& triangle, int32_t first_row, int32_t last_row, const FillTarget& target);
  /// The least of 8 × 8 depths, as bits; stride: from one to that above.
  uint32_t (*least_of_tile)(const uint32_t* depths, int32_t stride);
  /// Colours the pixels of a row (PixelPlane).
  void (*color_row)(const SlotColors& colors, const uint32_t* depths, const uint32_t* slots, int32_t count,
                    void* row);
  /// Whether tiles alone hide everything this deep, or deeper, at these pixels.
  bool (*hides)(float nearest, bool strict, const PixelRectangle& pixels, const DepthSource& source);
  /// At the centres of how many of these pixels the box may show. Stops once
  /// that is `enough`, which is at least 1, and gives no more.
  int32_t (*count_box)(const BoxTerms& box, const PixelRectangle& pixels, const DepthSource& source,
                       int32_t enough);
};

extern const RasterKernels sse42_kernels, avx2_kernels, avx512_kernels;

}  // namespace triptych
