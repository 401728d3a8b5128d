// Transparent triangles over what a visibility buffer holds: lists of fragments, pixel by pixel.
#pragma once

#include "raster/shading_counts.hpp"
#include "raster/triangle_shader.hpp"
#include "raster/visibility_buffer.hpp"

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

namespace triptych {

/// What a transparent triangle covers a pixel with.
struct TransparentFragment {
  uint32_t depth;  ///< bits of a positive float
  uint32_t slot;   ///< of TransparentLayers::table()
};

/// The fragments of an area of the picture, pixel by pixel. Keeps its room.
class TransparentFragments {
 public:
  const PixelBox& area() const { return area_; }
  size_t size() const { return sorted_.size(); }
  /// Of a pixel of the area: from the farthest to the nearest, and of equal ones that last which
  /// SlotTable::precedes() the others.
  std::span<const TransparentFragment> at(int32_t x, int32_t y) const {
    const size_t pixel = index(x, y);
    const size_t first = pixel == 0 ? 0 : ends_[pixel - 1];
    return std::span(sorted_).subspan(first, ends_[pixel] - first);
  }
  std::span<const TransparentFragment> all() const { return sorted_; }

 private:
  friend class TransparentLayers;
  struct Found {
    uint32_t pixel;
    TransparentFragment fragment;
  };
  size_t index(int32_t x, int32_t y) const {
    return static_cast<size_t>(y - area_.bottom) * static_cast<size_t>(area_.right - area_.left + 1) +
           static_cast<size_t>(x - area_.left);
  }
  void begin(const PixelBox& area);
  void sort(const SlotTable& table);

  PixelBox area_ = {0, -1, 0, -1};
  std::vector<Found> found_;
  std::vector<uint32_t> ends_;  ///< for each pixel where its fragments end
  std::vector<TransparentFragment> sorted_;
};

/// The transparent triangles of one sample of each pixel, set up; all that they cover is found when it is
/// asked for.
class TransparentLayers {
 public:
  /// opaque: what is drawn already; triangles that lie behind it may be left out. max_fragments:
  /// RasterOptions::max_fragments. With all threads. Error (place: frame target) for more triangles than can
  /// be numbered.
  TransparentLayers(const GeometryTerms& terms, std::span<const PlacedStretch> stretches,
                    const VisibilityBuffer& opaque, size_t max_fragments);

  const SlotTable& table() const { return table_; }
  const VisibilityBuffer& opaque() const { return *opaque_; }
  size_t max_fragments() const { return max_fragments_; }

  /// The fragments in an area that nothing opaque hides: those at one depth with something opaque, too.
  /// False, and none of them, where there are more than `most`.
  bool gather(const PixelBox& area, size_t most, TransparentFragments& fragments) const;

 private:
  const VisibilityBuffer* opaque_;
  size_t max_fragments_;
  SlotTable table_;
  std::vector<StretchTriangles> triangles_;
};

/// Blends them over colours, row by row from bottom to top, one band of rows in one thread.
class TransparentBlender {
 public:
  /// shader: of the view. last_row: of the band.
  TransparentBlender(const TransparentLayers& layers, const TriangleShader& shader, int32_t last_row);

  void blend(int32_t y, Rgba* row);
  /// How many, and how often there were too many for one list.
  uint64_t fragments() const { return blended_; }
  uint64_t splits() const { return splits_; }
  uint64_t smooth_triangles() const { return shades_.smooth_triangles(); }
  /// How many of the fragments had a texture.
  uint64_t textured() const { return textured_; }

 private:
  void blend_area(const PixelBox& area, Rgba* row);
  void compose(int32_t y, Rgba* row);
  float alpha(uint32_t slot);

  const TransparentLayers& layers_;
  const TriangleShader& shader_;
  KeptShades shades_;
  int32_t last_row_;
  TransparentFragments fragments_;
  struct KeptAlpha {
    uint32_t slot;
    float alpha;
  };
  std::vector<KeptAlpha> alphas_;  ///< of slots that were asked for a short while ago
  uint64_t blended_ = 0, splits_ = 0, textured_ = 0;
};

/// Of each sample's layers, if there are any.
class BandBlenders {
 public:
  BandBlenders(std::span<const TransparentLayers> layers, const TriangleShader& shader, int32_t last_row,
               ShadingCounts& counts);
  ~BandBlenders();
  BandBlenders(const BandBlenders&) = delete;
  BandBlenders& operator=(const BandBlenders&) = delete;

  void blend(size_t sample, int32_t y, Rgba* row);

 private:
  std::deque<TransparentBlender> blenders_;
  ShadingCounts& counts_;
};

/// The drawables of which any fragment shows, some of them several times.
void add_owners(const TransparentLayers& layers, std::vector<uint32_t>& drawables);

}  // namespace triptych
