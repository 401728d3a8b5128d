#include "raster/cap_fill.hpp"

#include "raster/caps.hpp"
#include "raster/fill.hpp"

#include <algorithm>
#include <bit>

namespace triptych {

namespace {

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
  CapFiller(const GeometryTerms& terms, int32_t first, int32_t last, CapCounters& counters,
            const FillTarget& target)
      : terms_(terms), first_(first), last_(last), counters_(counters), target_(target) {}

  /// A surface, all of whose runs are there: nothing, where none of its caps could win.
  void fill_whole(std::span<const CapRun> runs) {
    PixelBox box{target_.width, -1, target_.height, -1};
    float nearest = 0;
    for (const CapRun& run : runs) {
      if (!run.is_drawn) continue;
      for_each_triangle(run, first_, last_, [&](const WindowTriangle& triangle) {
        box = {std::min(box.left, triangle.left), std::max(box.right, triangle.right),
               std::min(box.bottom, std::max(triangle.bottom, first_)),
               std::max(box.top, std::min(triangle.top, last_))};
        nearest = std::max(nearest, limit_of(run, triangle).nearest);
      });
    }
    if (box.empty() || tiles_hide(target_, box, nearest)) return;
    for (const CapRun& run : runs) count(run, box);
    draw();
  }
  void count(const CapRun& run) { count(run, {0, target_.width - 1, first_, last_}); }
  /// Draws the caps of the surface that was counted, and forgets it.
  void draw() {
    for (int32_t y = first_; y <= last_; ++y) {
      CapCounters::Extent& row = counters_.row(y);
      for (int32_t x = row.left; x <= row.right; ++x) {
        CapCounters::Pixel& pixel = counters_.at(x, y);
        if (pixel.winding > 0 && pixel.limit > 0) write(pixel, x, y);
        pixel = {};
      }
      row = {};
    }
  }

 private:
  template <typename Visit>
  static void for_each_triangle(const CapRun& run, int32_t bottom, int32_t top, const Visit& visit) {
    if (run.triangles->bottom > top || run.triangles->top < bottom) return;
    for (const auto* const list : {&run.triangles->small, &run.triangles->large}) {
      for (const WindowTriangle& triangle : *list) {
        if (triangle.bottom <= top && triangle.top >= bottom) visit(triangle);
      }
    }
  }
  static const DepthLimit& limit_of(const CapRun& run, const WindowTriangle& triangle) {
    const RasterChunk& chunk = *run.range->chunk;
    const uint32_t number = run.range->first_triangle + (triangle.slot - run.range->first_slot);
    return run.triangles->limits[chunk.piece[chunk.corner[0][number]]];
  }
  void count(const CapRun& run, const PixelBox& box) {
    const bool mirrored = mirrors(run.range->placed);
    for_each_triangle(run, box.bottom, box.top, [&](const WindowTriangle& triangle) {
      if (triangle.left <= box.right && triangle.right >= box.left) count(run, triangle, mirrored, box);
    });
  }
  void count(const CapRun& run, const WindowTriangle& triangle, bool mirrored, const PixelBox& box) {
    WindowTriangle whole = triangle;
    whole.sides = nullptr;
    whole.limit = nullptr;  // whether it is drawn makes no difference
    const bool back = triangle.clockwise != mirrored;
    const DepthLimit* const limit = run.is_drawn ? &limit_of(run, triangle) : nullptr;
    for (int32_t y = std::max(triangle.bottom, box.bottom); y <= std::min(triangle.top, box.top); ++y) {
      CapCounters::Extent& row = counters_.row(y);
      row = {std::min(row.left, std::max(triangle.left, box.left)),
             std::max(row.right, std::min(triangle.right, box.right))};
    }
    for_each_pixel(whole, box.bottom, box.top, [&](int32_t x, int32_t y, float depth) {
      if (x < box.left || x > box.right) return;
      if (!(depth > 0) || !lies_beyond_entry(terms_.sides, run.range->cut, x, y, depth)) return;
      CapCounters::Pixel& pixel = counters_.at(x, y);
      pixel.winding += back ? 1 : -1;
      if (!back) return;
      if (depth < pixel.depth || (depth == pixel.depth && triangle.slot > pixel.slot)) return;
      pixel.depth = depth;
      pixel.slot = triangle.slot;
      pixel.limit = limit ? limit_at(*limit, x, y) : 0;
    });
  }
  void write(const CapCounters::Pixel& cap, int32_t x, int32_t y) {
    const float entry = entry_depth(terms_.sides, x, y), depth = std::min(entry, cap.limit);
    if (!(depth > 0) || !is_kept_at_entry(terms_.sides, x, y, entry)) return;
    const size_t at = static_cast<size_t>(y) * static_cast<size_t>(target_.stride) + static_cast<size_t>(x);
    const auto bits = std::bit_cast<uint32_t>(depth);
    if (bits < target_.depths[at]) return;
    if (target_.slots != nullptr) {
      if (bits == target_.depths[at] && !target_.precedes(target_.order, cap.slot, target_.slots[at])) return;
      target_.slots[at] = cap.slot;
    }
    target_.depths[at] = bits;
    target_.marked[int64_t{y / tile_side} * target_.columns + x / tile_side] = 1;
  }

  const GeometryTerms& terms_;
  const int32_t first_, last_;
  CapCounters& counters_;
  const FillTarget& target_;
};

}  // namespace

void fill_caps(const GeometryTerms& terms, std::span<const CapRun> runs, int32_t first, int32_t last,
               CapCounters& counters, const FillTarget& target) {
  CapFiller filler(terms, first, last, counters, target);
  while (!runs.empty()) {
    size_t count = 1;
    while (count < runs.size() && !runs[count].is_first) ++count;
    const auto surface = runs.first(count);
    if (surface.front().is_first && surface.back().is_last) {
      filler.fill_whole(surface);
    } else {
      for (const CapRun& run : surface) filler.count(run);
      if (surface.back().is_last) filler.draw();
    }
    runs = runs.subspan(count);
  }
}

}  // namespace triptych
