#include "raster/box_test.hpp"

#include "raster/instruction_set.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace triptych {

namespace {

/// Pixels from first to last, both included.
struct PixelRange {
  int first, last;
};

/// Pixels whose centres lie between two sides; sides from −1 to 1.
PixelRange pixels_between(float low, float high, int size) {
  // Floats of the sides are off by less than the margin of the outline, in the largest picture too.
  const double scale = size * 0.5;
  return {std::max(0, static_cast<int>(std::ceil((double{low} + 1) * scale - 0.5))),
          std::min(size - 1, static_cast<int>(std::floor((double{high} + 1) * scale - 0.5)))};
}

float centre(int pixel, int size) {
  return (2 * static_cast<float>(pixel) + 1) / static_cast<float>(size) - 1;
}

/// The pixels whose centres a rectangle holds.
struct Extent {
  PixelRange columns, rows;
  template <typename Sides>
  Extent(const VisibilityBuffer& buffer, const Sides& rectangle)
      : columns(pixels_between(rectangle.left, rectangle.right, buffer.width())),
        rows(pixels_between(rectangle.bottom, rectangle.top, buffer.height())) {}
  bool empty() const { return columns.first > columns.last || rows.first > rows.last; }
  PixelRectangle pixels() const { return {columns.first, columns.last, rows.first, rows.last}; }
};

/// The test of one rectangle. Where whole tiles decide, they do: in IEEE arithmetic sums and products are
/// monotone in each operand, so that what a plane gives at the outermost pixel centres of a tile bounds, to
/// the bit, what it gives at those between them.
class RectangleTest {
 public:
  RectangleTest(const VisibilityBuffer& buffer, const ScreenRectangle& rectangle, const Extent& extent,
                bool strict, uint32_t enough)
      : buffer_(buffer),
        rectangle_(rectangle),
        strict_(strict),
        columns_(extent.columns),
        rows_(extent.rows),
        enough_(enough) {}

  /// At how many pixels it passes; at most `enough`.
  uint32_t count() {
    for (int y = rows_.first / DepthTiles::block; y <= rows_.last / DepthTiles::block; ++y) {
      for (int x = columns_.first / DepthTiles::block; x <= columns_.last / DepthTiles::block; ++x) {
        if (!behind(rectangle_.planes[0].middle, buffer_.tiles().farthest_of_block(x, y)) &&
            is_enough_with_block(x, y))
          return enough_;
      }
    }
    return count_;
  }

 private:
  /// Whether something this deep is hidden by what is there.
  bool behind(float depth, float there) const { return strict_ ? !(depth > there) : !(depth >= there); }

  /// What of a range lies in a square of so many pixels.
  static PixelRange within(const PixelRange& range, int square, int side) {
    return {std::max(range.first, square * side), std::min(range.last, (square + 1) * side - 1)};
  }

  bool is_enough_with_block(int block_x, int block_y) {
    constexpr int side = DepthTiles::tile;
    const PixelRange across = within(columns_, block_x, DepthTiles::block),
                     up = within(rows_, block_y, DepthTiles::block);
    for (int y = up.first / side; y <= up.last / side; ++y) {
      for (int x = across.first / side; x <= across.last / side; ++x) {
        const float there = buffer_.tiles().farthest(x, y);
        // The level plane alone decides nearly everything.
        if (behind(rectangle_.planes[0].middle, there)) continue;
        const PixelRange columns = within(across, x, side), rows = within(up, y, side);
        if (may_reach(columns, rows, there) && is_enough_with_pixels(columns, rows)) return true;
      }
    }
    return false;
  }

  bool may_reach(const PixelRange& columns, const PixelRange& rows, float there) const {
    const float left = centre(columns.first, buffer_.width()), right = centre(columns.last, buffer_.width()),
                bottom = centre(rows.first, buffer_.height()), top = centre(rows.last, buffer_.height());
    const auto most = [&](const auto& plane, const glm::vec2& direction) {
      return plane.at(direction.x > 0 ? right : left, direction.y > 0 ? top : bottom);
    };
    for (const DepthPlane& plane : rectangle_.planes) {
      const float depth = most(plane, plane.slope);
      if ((strict_ ? depth <= there : depth < there) || depth < 0) return false;
    }
    return std::none_of(rectangle_.cuts.begin(), rectangle_.cuts.end(),
                        [&](const HalfPlane& cut) { return most(cut, cut.normal) < 0; });
  }

  bool is_enough_with_pixels(const PixelRange& columns, const PixelRange& rows) {
    for (int row = rows.first; row <= rows.last; ++row) {
      const float y = centre(row, buffer_.height());
      for (int column = columns.first; column <= columns.last; ++column) {
        const float there = buffer_.depth(column, row), x = centre(column, buffer_.width());
        const float depth = rectangle_.depth(x, y);
        if (behind(depth, there)) continue;
        if (depth >= 0 &&
            std::all_of(rectangle_.cuts.begin(), rectangle_.cuts.end(),
                        [&](const HalfPlane& cut) { return cut.at(x, y) >= 0; }) &&
            ++count_ == enough_)
          return true;
      }
    }
    return false;
  }

  const VisibilityBuffer& buffer_;
  const ScreenRectangle& rectangle_;
  bool strict_;
  PixelRange columns_, rows_;
  uint32_t enough_, count_ = 0;
};

/// Planes of both kinds have the layout of PlaneTerms.
template <typename Planes>
void copy_planes(const Planes& planes, PlaneTerms (&terms)[4]) {
  static_assert(sizeof planes == sizeof terms);
  std::memcpy(terms, planes.data(), sizeof terms);
}

uint32_t count_with(const RasterKernels& kernels, const VisibilityBuffer& buffer,
                    const ScreenRectangle& rectangle, const Extent& extent, bool strict, uint32_t enough) {
  BoxTerms terms;
  copy_planes(rectangle.planes, terms.planes);
  copy_planes(rectangle.cuts, terms.cuts);
  terms.strict = strict;
  // No picture has more pixels.
  const auto most = static_cast<int32_t>(std::min(enough, uint32_t{1} << 30));
  return static_cast<uint32_t>(kernels.count_box(terms, extent.pixels(), buffer.source(), most));
}

}  // namespace

uint32_t count_pixels(const VisibilityBuffer& buffer, const ScreenRectangle& rectangle, bool strict,
                      uint32_t enough) {
  const Extent extent(buffer, rectangle);
  if (extent.empty()) return 0;
  if (const RasterKernels* const kernels = raster_kernels(instruction_set()))
    return count_with(*kernels, buffer, rectangle, extent, strict, enough);
  return RectangleTest(buffer, rectangle, extent, strict, enough).count();
}

bool hides(const VisibilityBuffer& buffer, const ScreenExtent& sides, bool strict) {
  const Extent extent(buffer, sides);
  if (extent.empty()) return true;
  if (const RasterKernels* const kernels = raster_kernels(instruction_set()))
    return kernels->hides(sides.nearest, strict, extent.pixels(), buffer.source());
  constexpr int side = DepthTiles::tile;
  for (int y = extent.rows.first / side; y <= extent.rows.last / side; ++y) {
    for (int x = extent.columns.first / side; x <= extent.columns.last / side; ++x) {
      const float there = buffer.tiles().farthest(x, y);
      if (strict ? sides.nearest > there : sides.nearest >= there) return false;
    }
  }
  return true;
}

}  // namespace triptych
