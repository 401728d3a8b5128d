#include "raster/visibility_buffer.hpp"

#include "base/threads.hpp"
#include "raster/float_state.hpp"
#include "raster/instruction_set.hpp"

#include <algorithm>
#include <bit>
#include <functional>

namespace triptych {

namespace {

/// Triangles that are set up before they are filled: what stays in the processor's caches.
constexpr uint64_t batch_size = 16384;
/// Fewer are not worth waking other threads.
constexpr uint64_t worth_sharing = 1024;
/// Bands are whole tiles of so many rows.
constexpr int32_t tile_rows = DepthTiles::tile;

/// All of them here where they are few.
void for_each(size_t count, bool side_by_side, const std::function<void(size_t)>& body) {
  const auto in_own_state = [&](size_t i) {
    const FloatState state;
    body(i);
  };
  if (side_by_side) {
    parallel_for(count, in_own_state);
  } else {
    for (size_t i = 0; i < count; ++i) in_own_state(i);
  }
}

}  // namespace

VisibilityBuffer::VisibilityBuffer(int width, int height, bool depth_alone, uint64_t max_slots)
    : width_(width),
      height_(height),
      depth_alone_(depth_alone),
      tiles_(width, height),
      slots_(
          std::max<uint64_t>(max_slots, static_cast<uint64_t>(width) * static_cast<uint64_t>(height) + 1)) {
  const size_t pixels = static_cast<size_t>(width) * static_cast<size_t>(height);
  if (depth_alone) {
    depths_.assign(pixels, 0);
  } else {
    words_.assign(pixels, 0);
  }
}

void VisibilityBuffer::clear() {
  std::fill(words_.begin(), words_.end(), 0);
  std::fill(depths_.begin(), depths_.end(), 0);
  tiles_.clear();
  slots_.clear();
}

float VisibilityBuffer::depth(int x, int y) const {
  return std::bit_cast<float>(depth_alone_ ? depths_[index(x, y)]
                                           : static_cast<uint32_t>(words_[index(x, y)] >> 32));
}

std::optional<SlotTable::Triangle> VisibilityBuffer::triangle(int x, int y) const {
  const VisibilityWord word = words_[index(x, y)];
  if (word == 0) return std::nullopt;
  return slots_.find(slot_of(word));
}

void VisibilityBuffer::draw(const GeometryTerms& terms, std::span<const PlacedStretch> stretches) {
  for (const PlacedStretch& stretch : stretches) {
    for (uint32_t first = 0; first < stretch.triangle_count;) {
      if (slots_.left() == 0) {
        draw_batch(terms);
        slots_.compact(words_);
      }
      const uint32_t count = static_cast<uint32_t>(
          std::min<uint64_t>({stretch.triangle_count - first, slots_.left(), batch_size}));
      number(stretch, first, count);
      first += count;
      if (batch_triangles_ >= batch_size) draw_batch(terms);
    }
  }
  draw_batch(terms);
}

void VisibilityBuffer::number(const PlacedStretch& stretch, uint32_t first, uint32_t count) {
  DrawnRange range{.rank = stretch.rank,
                   .part = stretch.part,
                   .first_triangle = stretch.first_triangle + first,
                   .triangle_count = count,
                   .chunk = stretch.chunk,
                   .placed = stretch.placed};
  if (!depth_alone_) range.first_slot = slots_.add(range);
  batch_.push_back({range, stretch.pieces});
  batch_triangles_ += count;
}

void VisibilityBuffer::draw_batch(const GeometryTerms& terms) {
  if (batch_.empty()) return;
  if (triangles_.size() < batch_.size()) triangles_.resize(batch_.size());
  const bool side_by_side = thread_count() > 1 && batch_triangles_ >= worth_sharing;
  for_each(batch_.size(), side_by_side,
           [&](size_t i) { make_triangles(terms, batch_[i].range, batch_[i].pieces, triangles_[i]); });
  const int32_t tiles = (height_ + tile_rows - 1) / tile_rows;
  const int32_t bands = side_by_side ? std::min(tiles, static_cast<int32_t>(thread_count()) * 4) : 1;
  for_each(static_cast<size_t>(bands), side_by_side, [&](size_t i) {
    const auto band = static_cast<int32_t>(i);
    fill_rows(tiles * band / bands * tile_rows,
              std::min(tiles * (band + 1) / bands * tile_rows, height_) - 1);
  });
  batch_.clear();
  batch_triangles_ = 0;
  if (depth_alone_) {
    tiles_.refresh(std::span<const uint32_t>(depths_));
  } else {
    tiles_.refresh(std::span<const VisibilityWord>(words_));
  }
}

void VisibilityBuffer::fill_depths(const WindowTriangle& triangle, int32_t first, int32_t last,
                                   const RasterKernels* kernels) {
  if (kernels != nullptr && triangle.is_plain()) {
    kernels->fill_depths(triangle, first, last, depths_.data(), width_);
  } else {
    fill(triangle, first, last, PixelBuffer<uint32_t>{depths_.data(), width_}, DepthWriter{});
  }
}

void VisibilityBuffer::fill_words(const WindowTriangle& triangle, int32_t first, int32_t last,
                                  const RasterKernels* kernels) {
  Rows rows{first, last};
  // Where depths are equal slots are compared; what the kernel has written stays as it is.
  if (kernels != nullptr && triangle.is_plain())
    rows = kernels->fill_words(triangle, first, last, words_.data(), width_);
  fill(triangle, rows.first, rows.last, PixelBuffer<VisibilityWord>{words_.data(), width_},
       VisibilityWriter{slots_});
}

[[gnu::noinline]] void VisibilityBuffer::fill_rows(int32_t first, int32_t last) {
  const RasterKernels* kernels = raster_kernels(instruction_set());
  if (kernels != nullptr && width_ < kernels->min_width) kernels = nullptr;
  for (size_t i = 0; i < batch_.size(); ++i) {
    const StretchTriangles& stretch = triangles_[i];
    if (stretch.bottom > last || stretch.top < first) continue;
    for (const WindowTriangle& triangle : stretch.triangles) {
      if (triangle.bottom > last || triangle.top < first) continue;
      tiles_.mark(triangle.left, triangle.right, std::max(triangle.bottom, first),
                  std::min(triangle.top, last));
      if (depth_alone_) {
        fill_depths(triangle, first, last, kernels);
      } else {
        fill_words(triangle, first, last, kernels);
      }
    }
  }
}

}  // namespace triptych
