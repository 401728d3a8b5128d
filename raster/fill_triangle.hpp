// What filling a triangle takes: plain data, for code that is compiled once for each instruction set.
#pragma once

#include <cstdint>

namespace triptych {

/// Tiles are squares of so many pixels, blocks of 8 × 8 tiles (DepthTiles).
constexpr int32_t tile_side = 8, block_side = 64;

/// The depth that pixels of a piece may have at most: PixelDepthBound as plain numbers.
struct DepthLimit {
  float x[3], y[3], at[3];
  float nearest;
};

/// The sides of a section as plain numbers (PixelSide), of one sample of each pixel.
struct SectionSidesOver {
  static constexpr int32_t max = 12;
  float x[max], y[max], at[max], of_depth[max];
  int32_t count;
};

/// A triangle whose box holds at least one pixel centre of the picture. Pixel (left + i, bottom + j) is
/// covered where all of edge[k] + step_x[k] · i + step_y[k] · j ≥ 0; an edge's own pixels belong to it where
/// it is a left or a top one (y up). Its depth there is
///
///   clamp((z + slope_y · dy) + slope_x · dx, low, high),   dx, dy: sub-pixels from the first corner
///
/// in this order, in floats. Where those might be too coarse, as for slivers and for what the near plane
/// cuts, it is `precise`: the sum is made in doubles, of the precise slopes, and rounded to a float once.
/// Where it is not proven to keep the limit of its piece, `limit` has that, and the farther of both counts.
/// Where a section may cut it, it is drawn at those depths that all of the sides keep whose bits are in
/// `cut`.
struct FillTriangle {
  int64_t edge[3];
  int32_t step_x[3], step_y[3];
  int32_t left, right, bottom, top;  ///< pixels, inclusive
  int32_t first_x, first_y;          ///< the first corner, sub-pixels
  float z, slope_x, slope_y;         ///< depth there, and what it changes by a sub-pixel
  float low, high;                   ///< the corners' depths
  uint32_t slot;
  bool precise;
  double precise_x, precise_y;
  const DepthLimit* limit;        ///< or null
  const SectionSidesOver* sides;  ///< or null, where `cut` is 0
  uint32_t cut;
};

/// As many triangles as the widest vector has lanes, their numbers side by side: none wider than a vector of
/// those who made them, none precise, limited or cut, and all of their edge functions within 32 bits.
struct NarrowTriangles {
  static constexpr int32_t count = 16;
  int32_t edge[3][count], step_x[3][count], step_y[3][count];
  int32_t left[count], right[count], bottom[count], top[count];
  int32_t first_x[count], first_y[count];
  float z[count], slope_x[count], slope_y[count], low[count], high[count];
  uint32_t slot[count];
  uint32_t held;                    ///< a bit for each that there is, the first one's lowest
  int32_t lowest_row, highest_row;  ///< of them all
};

/// Of triangles of few pixels these pixels, one of each array: where, how deep, and of which triangle.
struct Fragments {
  uint32_t* places;  ///< the row in the upper 16 bits, the column in the lower
  uint32_t* depths;  ///< bits of positive floats
  uint32_t* slots;
};

/// What triangles are filled into (PixelPlane).
struct FillTarget {
  int32_t width, height, stride;
  uint32_t* depths;  ///< the bits of positive floats; 0 where nothing was drawn
  uint32_t* slots;   ///< of the triangles that show, or null; without meaning where nothing was drawn
  /// The farthest depths of tiles of 8 × 8 pixels, `columns` in a row of them (DepthTiles). `marked` are
  /// those that may hold less than what is there.
  float* tiles;
  uint8_t* marked;
  int32_t columns;
  /// Which slot wins where depths are equal.
  const void* order;
  bool (*precedes)(const void* order, uint32_t slot, uint32_t other);
};

}  // namespace triptych
