#include "raster/transparent_layers.hpp"

#include "base/error.hpp"
#include "base/threads.hpp"
#include "raster/fill.hpp"
#include "raster/float_state.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace triptych {

namespace {

/// Triangles that one thread sets up at once.
constexpr uint32_t share = 4096;
constexpr uint32_t kept_alphas = 256;

template <typename Visit>
void for_each_triangle(const StretchTriangles& stretch, int32_t bottom, int32_t top, const Visit& visit) {
  if (stretch.bottom > top || stretch.top < bottom) return;
  for (const auto* const triangles : {&stretch.small, &stretch.large}) {
    for (const WindowTriangle& triangle : *triangles) {
      if (triangle.bottom <= top && triangle.top >= bottom) visit(triangle);
    }
  }
}

}  // namespace

TransparentLayers::TransparentLayers(const GeometryTerms& terms, std::span<const PlacedStretch> stretches,
                                     const VisibilityBuffer& opaque, size_t max_fragments)
    : opaque_(&opaque), max_fragments_(max_fragments), table_(std::numeric_limits<uint32_t>::max()) {
  struct Entry {
    DrawnRange range;
    std::span<const LatticeBox> pieces;
  };
  std::vector<Entry> entries;
  for (const PlacedStretch& stretch : stretches) {
    if (table_.left() < stretch.triangle_count)
      fail("frame target", "more transparent triangles than the device cpu can number");
    for (uint32_t first = 0; first < stretch.triangle_count; first += share) {
      DrawnRange range{.rank = stretch.rank,
                       .part = stretch.part,
                       .first_triangle = stretch.first_triangle + first,
                       .triangle_count = std::min(stretch.triangle_count - first, share),
                       .cut = stretch.cut,
                       .transparent = true,
                       .chunk = stretch.chunk,
                       .placed = stretch.placed};
      range.first_slot = table_.add(range);
      entries.push_back({range, stretch.pieces});
    }
  }
  triangles_.resize(entries.size());
  const DepthSource drawn = opaque.source();
  parallel_for(entries.size(), [&](size_t i) {
    const FloatState state;
    make_triangles(terms, entries[i].range, entries[i].pieces, drawn, triangles_[i]);
  });
}

void TransparentFragments::begin(const PixelBox& area) {
  area_ = area;
  found_.clear();
  sorted_.clear();
  ends_.assign(index(area.right, area.top) + 1, 0);
}

/// By counting those of each pixel; few are of one.
void TransparentFragments::sort(const SlotTable& table) {
  for (const Found& found : found_) ++ends_[found.pixel];
  uint32_t sum = 0;
  for (uint32_t& end : ends_) sum = std::exchange(end, sum) + sum;
  sorted_.resize(found_.size());
  for (const auto& [pixel, fragment] : found_) sorted_[ends_[pixel]++] = fragment;
  const auto lies_behind = [&](const TransparentFragment& a, const TransparentFragment& b) {
    return a.depth != b.depth ? a.depth < b.depth : table.precedes(b.slot, a.slot);
  };
  size_t first = 0;
  for (const uint32_t end : ends_) {
    if (end - first > 1)
      std::sort(sorted_.begin() + static_cast<ptrdiff_t>(first), sorted_.begin() + end, lies_behind);
    first = end;
  }
}

bool TransparentLayers::gather(const PixelBox& area, size_t most, TransparentFragments& fragments) const {
  fragments.begin(area);
  bool fits = true;
  for (size_t i = 0; i < triangles_.size() && fits; ++i) {
    for_each_triangle(triangles_[i], area.bottom, area.top, [&](const WindowTriangle& triangle) {
      if (!fits || triangle.right < area.left || triangle.left > area.right) return;
      for_each_pixel(triangle, area.bottom, area.top, [&](int32_t x, int32_t y, float depth) {
        if (!(depth > 0) || x < area.left || x > area.right) return;
        const auto bits = std::bit_cast<uint32_t>(depth);
        if (bits < opaque_->depths(y)[static_cast<size_t>(x)]) return;
        fits = fits && fragments.found_.size() < most;
        if (fits)
          fragments.found_.push_back({static_cast<uint32_t>(fragments.index(x, y)), {bits, triangle.slot}});
      });
    });
  }
  if (!fits) {
    fragments.begin(area);
    return false;
  }
  fragments.sort(table_);
  return true;
}

TransparentBlender::TransparentBlender(const TransparentLayers& layers, const TriangleShader& shader,
                                       int32_t last_row)
    : layers_(layers), shader_(shader), shades_(layers.table(), shader), last_row_(last_row) {
  for (uint32_t i = 0; i < kept_alphas; ++i) alphas_.push_back({i + 1, 0});  // none of them belongs there
}

void TransparentBlender::blend(int32_t y, Rgba* row) {
  const int32_t right = layers_.opaque().width() - 1;
  for (int32_t top = last_row_; y > fragments_.area().top; top = y + (top - y) / 2) {
    if (layers_.gather({0, right, y, top}, layers_.max_fragments(), fragments_)) break;
    ++splits_;
    if (top == y) return blend_area({0, right, y, y}, row);
    fragments_ = {};
  }
  compose(y, row);
}

/// Of one row, of which there are too many.
void TransparentBlender::blend_area(const PixelBox& area, Rgba* row) {
  const size_t most = area.left == area.right ? std::numeric_limits<size_t>::max() : layers_.max_fragments();
  if (layers_.gather(area, most, fragments_)) {
    compose(area.bottom, row);
  } else {
    ++splits_;
    const int32_t middle = area.left + (area.right - area.left) / 2;
    blend_area({area.left, middle, area.bottom, area.top}, row);
    blend_area({middle + 1, area.right, area.bottom, area.top}, row);
  }
  fragments_ = {};
}

void TransparentBlender::compose(int32_t y, Rgba* row) {
  for (int32_t x = fragments_.area().left; x <= fragments_.area().right; ++x) {
    const auto fragments = fragments_.at(x, y);
    if (fragments.empty()) continue;
    Rgba& pixel = row[x];
    float color[3] = {pixel[0] / 255.0f, pixel[1] / 255.0f, pixel[2] / 255.0f};
    for (const auto& [depth, slot] : fragments) {
      const Rgba over = shades_.varies(slot) ? shades_.of(slot, x, y) : shades_.of(slot);
      const bool textured = shades_.kinds(slot).textured;
      textured_ += textured;
      const float covered = textured ? static_cast<float>(over[3]) / 255.0f : alpha(slot);
      for (size_t k = 0; k < 3; ++k) color[k] += covered * (static_cast<float>(over[k]) / 255.0f - color[k]);
    }
    for (size_t k = 0; k < 3; ++k) pixel[k] = static_cast<uint8_t>(std::rint(color[k] * 255.0f));
    blended_ += fragments.size();
  }
}

float TransparentBlender::alpha(uint32_t slot) {
  KeptAlpha& kept = alphas_[slot % kept_alphas];
  if (kept.slot != slot) kept = {slot, shader_.alpha(layers_.table().find(slot))};
  return kept.alpha;
}

BandBlenders::BandBlenders(std::span<const TransparentLayers> layers, const TriangleShader& shader,
                           int32_t last_row, ShadingCounts& counts)
    : counts_(counts) {
  for (const TransparentLayers& of_sample : layers) blenders_.emplace_back(of_sample, shader, last_row);
}

BandBlenders::~BandBlenders() {
  for (const TransparentBlender& blender : blenders_) {
    counts_.blended_fragments += blender.fragments();
    counts_.splits += blender.splits();
    counts_.smooth_triangles += blender.smooth_triangles();
    counts_.varying_pixels[static_cast<size_t>(ShadeKind::textured)] += blender.textured();
  }
}

void BandBlenders::blend(size_t sample, int32_t y, Rgba* row) {
  if (blenders_.empty()) return;
  const TimedShading timed(counts_.blending_ms);
  blenders_[sample].blend(y, row);
}

void add_owners(const TransparentLayers& layers, std::vector<uint32_t>& drawables) {
  const VisibilityBuffer& opaque = layers.opaque();
  TransparentFragments fragments;
  constexpr int32_t rows = 16;
  for (int32_t y = 0; y < opaque.height(); y += rows) {
    const int32_t top = std::min(y + rows, opaque.height()) - 1;
    layers.gather({0, opaque.width() - 1, y, top}, std::numeric_limits<size_t>::max(), fragments);
    for (const TransparentFragment& fragment : fragments.all())
      drawables.push_back(layers.table().find(fragment.slot).range->rank.id);
  }
}

}  // namespace triptych
