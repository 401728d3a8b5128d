// Cut surfaces of solids: where a ray comes into what a section keeps, within something solid.
#pragma once

#include "raster/geometry_stage.hpp"

#include <span>
#include <vector>

namespace triptych {

/// What rays through the pixels of a picture pass, beyond where they come in. All 0 between uses.
class CapCounters {
 public:
  struct Pixel {
    int32_t winding = 0;
    float depth = 0;    ///< of the nearest back
    uint32_t slot = 0;  ///< its triangle's
    float limit = 0;    ///< of its piece; 0 where that is not drawn
  };
  void make_room(int32_t width, int32_t height) {
    if (width_ == width && static_cast<int32_t>(rows_.size()) == height) return;
    width_ = width;
    rows_.assign(static_cast<size_t>(height), {});
    pixels_.assign(static_cast<size_t>(width) * static_cast<size_t>(height), {});
  }
  Pixel& at(int32_t x, int32_t y) {
    return pixels_[static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x)];
  }
  /// The pixels of a row that are counted, both included.
  struct Extent {
    int32_t left = INT32_MAX, right = -1;
  };
  Extent& row(int32_t y) { return rows_[static_cast<size_t>(y)]; }

 private:
  int32_t width_ = 0;
  std::vector<Extent> rows_;
  std::vector<Pixel> pixels_;
};

/// Some triangles of a closed surface that a section may cut: all of those that cover pixels, whatever is
/// drawn before them.
struct CapRun {
  const DrawnRange* range;  ///< numbered; the slots of a surface's runs ascend
  const StretchTriangles* triangles;
  bool is_drawn;           ///< or only counts
  bool is_first, is_last;  ///< of its surface
};

/// A ray's winding number where it comes in is what lies behind it: of the triangles of a closed surface the
/// backs that it passes from there on, less the fronts. Where that is above 0, the ray is inside of it, and
/// its cap is drawn: as deep as the ray comes in, and with the slot of the nearest back behind it, if the run
/// of that is drawn. Caps are held to the limit of that back's piece as all that is drawn of it, and lie
/// where that is drawn: so bounds of boxes hold for them, and no culling changes one.
///
/// Runs: surface by surface. One whose last run is not there is counted, and goes on at the next call with
/// the same rows. Rows first to last, both included.
void fill_caps(const GeometryTerms& terms, std::span<const CapRun> runs, int32_t first, int32_t last,
               CapCounters& counters, const FillTarget& target);

}  // namespace triptych
