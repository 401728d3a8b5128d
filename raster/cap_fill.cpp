#include "raster/cap_fill.hpp"

#include "raster/caps.hpp"
#include "raster/fill.hpp"

#include <algorithm>
#include <bit>
#include <vector>

namespace triptych {

namespace {

/// What rays through the pixels of some rows pass, beyond where they come in. All 0 between uses.
struct Passed {
  struct Pixel {
    int32_t winding = 0;
    float depth = 0;    ///< of the nearest back
    uint32_t slot = 0;  ///< its triangle's
    float limit = 0;    ///< of its piece
  };
  std::vector<Pixel> pixels;
  int32_t width = 0, bottom = 0;

  void make_room(int32_t of_width, int32_t first, int32_t last) {
    width = of_width;
    bottom = first;
    const auto size = static_cast<size_t>(of_width) * static_cast<size_t>(last - first + 1);
    if (pixels.size() < size) pixels.resize(size);
  }
  Pixel& at(int32_t x, int32_t y) {
    return pixels[static_cast<size_t>(y - bottom) * static_cast<size_t>(width) + static_cast<size_t>(x)];
  }
};

/// Whether a ray comes in at one of these sides, and all at which it does keep what is so deep.
bool lies_beyond_entry(const SectionSidesOver& sides, uint32_t cut, int32_t x, int32_t y, float depth) {
  const float px = static_cast<float>(x) + 0.5f, py = static_cast<float>(y) + 0.5f;
  bool entered = false;
  for (int i = 0; cut != 0; ++i, cut >>= 1) {
    if ((cut & 1) == 0) continue;
    const float along = (sides.x[i] * px + sides.y[i] * py) + sides.at[i];
    if (!(along + sides.of_depth[i] < 0)) continue;
    if (!(along + sides.of_depth[i] * depth >= 0)) return false;
    entered = true;
  }
  return entered;
}

/// Whether the ray is still in what the sides keep at a depth at which it came in: it may have left before.
bool is_kept_at_entry(const SectionSidesOver& sides, int32_t x, int32_t y, float depth) {
  const float px = static_cast<float>(x) + 0.5f, py = static_cast<float>(y) + 0.5f;
  for (int32_t i = 0; i < sides.count; ++i) {
    const float along = (sides.x[i] * px + sides.y[i] * py) + sides.at[i];
    const bool comes_in = along + sides.of_depth[i] < 0;
    if (!comes_in && !(along + sides.of_depth[i] * depth >= 0)) return false;
  }
  return true;
}

bool tiles_hide(const FillTarget& target, const PixelBox& box, float nearest) {
  for (int32_t y = box.bottom / tile_side; y <= box.top / tile_side; ++y) {
    const float* const tiles = target.tiles + int64_t{y} * target.columns;
    for (int32_t x = box.left / tile_side; x <= box.right / tile_side; ++x) {
      if (!(nearest < tiles[x])) return false;
    }
  }
  return true;
}

class CapFiller {
 public:
  CapFiller(const GeometryTerms& terms, const DrawnRange& range, const StretchTriangles& triangles,
            Passed& passed)
      : terms_(terms),
        range_(range),
        triangles_(triangles),
        passed_(passed),
        mirrors_(mirrors(range.placed)) {}

  template <typename Visit>
  void for_each_triangle(int32_t first, int32_t last, const Visit& visit) const {
    for (const auto* const list : {&triangles_.small, &triangles_.large}) {
      for (const WindowTriangle& triangle : *list) {
        if (triangle.bottom <= last && triangle.top >= first) visit(triangle);
      }
    }
  }
  const DepthLimit& limit_of(const WindowTriangle& triangle) const {
    const RasterChunk& chunk = *range_.chunk;
    return triangles_.limits[chunk.piece[chunk.corner[0][number(triangle)]]];
  }
  void pass(const WindowTriangle& triangle, int32_t first, int32_t last) {
    WindowTriangle whole = triangle;
    whole.sides = nullptr;
    const bool back = triangle.clockwise != mirrors_;
    const DepthLimit& limit = limit_of(triangle);
    for_each_pixel(whole, first, last, [&](int32_t x, int32_t y, float depth) {
      if (!(depth > 0) || !lies_beyond_entry(terms_.sides, range_.cut, x, y, depth)) return;
      Passed::Pixel& pixel = passed_.at(x, y);
      pixel.winding += back ? 1 : -1;
      if (!back) return;
      if (depth < pixel.depth || (depth == pixel.depth && triangle.slot > pixel.slot)) return;
      pixel.depth = depth;
      pixel.slot = triangle.slot;
      pixel.limit = limit_at(limit, x, y);
    });
  }
  void draw(const PixelBox& box, const FillTarget& target) {
    for (int32_t y = box.bottom; y <= box.top; ++y) {
      for (int32_t x = box.left; x <= box.right; ++x) {
        Passed::Pixel& pixel = passed_.at(x, y);
        if (pixel.winding > 0) write(pixel, x, y, target);
        pixel = {};
      }
    }
  }

 private:
  uint32_t number(const WindowTriangle& triangle) const {
    return range_.first_triangle + (triangle.slot - range_.first_slot);
  }
  void write(const Passed::Pixel& cap, int32_t x, int32_t y, const FillTarget& target) {
    const float entry = entry_depth(terms_.sides, x, y), depth = std::min(entry, cap.limit);
    if (!(depth > 0) || !is_kept_at_entry(terms_.sides, x, y, entry)) return;
    const size_t at = static_cast<size_t>(y) * static_cast<size_t>(target.stride) + static_cast<size_t>(x);
    const auto bits = std::bit_cast<uint32_t>(depth);
    if (bits < target.depths[at]) return;
    if (target.slots != nullptr) {
      if (bits == target.depths[at] && !target.precedes(target.order, cap.slot, target.slots[at])) return;
      target.slots[at] = cap.slot;
    }
    target.depths[at] = bits;
    target.marked[int64_t{y / tile_side} * target.columns + x / tile_side] = 1;
  }

  const GeometryTerms& terms_;
  const DrawnRange& range_;
  const StretchTriangles& triangles_;
  Passed& passed_;
  const bool mirrors_;
};

}  // namespace

void fill_caps(const GeometryTerms& terms, const DrawnRange& range, const StretchTriangles& triangles,
               int32_t first, int32_t last, const FillTarget& target) {
  static thread_local Passed passed;
  CapFiller filler(terms, range, triangles, passed);
  PixelBox box{target.width, -1, target.height, -1};
  float nearest = 0;
  filler.for_each_triangle(first, last, [&](const WindowTriangle& triangle) {
    box = {std::min(box.left, triangle.left), std::max(box.right, triangle.right),
           std::min(box.bottom, std::max(triangle.bottom, first)),
           std::max(box.top, std::min(triangle.top, last))};
    nearest = std::max(nearest, filler.limit_of(triangle).nearest);
  });
  if (box.empty() || tiles_hide(target, box, nearest)) return;
  passed.make_room(target.width, box.bottom, box.top);
  filler.for_each_triangle(
      first, last, [&](const WindowTriangle& triangle) { filler.pass(triangle, box.bottom, box.top); });
  filler.draw(box, target);
}

}  // namespace triptych
