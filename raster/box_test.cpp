#include "raster/box_test.hpp"

#include <algorithm>
#include <cmath>

namespace triptych {

namespace {

/// Pixels whose centres lie between two sides, both included; sides from −1 to 1.
struct PixelRange {
  int first, last;
  PixelRange(float low, float high, int size) {
    // Floats of the sides are off by less than the margin of the outline, in the largest picture too.
    const double scale = size * 0.5;
    first = std::max(0, static_cast<int>(std::ceil((double{low} + 1) * scale - 0.5)));
    last = std::min(size - 1, static_cast<int>(std::floor((double{high} + 1) * scale - 0.5)));
  }
};

float centre(int pixel, int size) {
  return (2 * static_cast<float>(pixel) + 1) / static_cast<float>(size) - 1;
}

}  // namespace

bool may_show(const VisibilityBuffer& buffer, const ScreenRectangle& rectangle, bool strict) {
  const PixelRange columns(rectangle.left, rectangle.right, buffer.width()),
      rows(rectangle.bottom, rectangle.top, buffer.height());
  for (int row = rows.first; row <= rows.last; ++row) {
    const float y = centre(row, buffer.height());
    for (int column = columns.first; column <= columns.last; ++column) {
      const float there = buffer.depth(column, row);
      // The level plane alone decides nearly everything.
      if (rectangle.planes[0].middle < there) continue;
      const float x = centre(column, buffer.width());
      const float depth = rectangle.depth(x, y);
      if (strict ? !(depth > there) : !(depth >= there)) continue;
      if (depth >= 0 && std::all_of(rectangle.cuts.begin(), rectangle.cuts.end(),
                                    [&](const HalfPlane& cut) { return cut.at(x, y) >= 0; }))
        return true;
    }
  }
  return false;
}

}  // namespace triptych
