#include "raster/visibility_buffer.hpp"

#include "base/threads.hpp"
#include "raster/float_state.hpp"
#include "raster/instruction_set.hpp"

#include <algorithm>
#include <bit>

namespace triptych {

namespace {

/// Triangles that are set up before they are filled: what stays in the processor's caches.
constexpr uint64_t batch_size = 4096;
/// Fewer are not worth waking other threads.
constexpr uint64_t worth_sharing = 1024;
/// Bands are whole tiles of so many rows.
constexpr int32_t tile_rows = DepthTiles::tile;

}  // namespace

VisibilityBuffer::VisibilityBuffer(int width, int height, bool depth_alone, uint64_t max_slots)
    : width_(width),
      height_(height),
      depth_alone_(depth_alone),
      depths_(width, height),
      slots_(depth_alone ? PixelPlane() : PixelPlane(width, height)),
      tiles_(width, height),
      table_(
          std::max<uint64_t>(max_slots, static_cast<uint64_t>(width) * static_cast<uint64_t>(height) + 1)) {}

void VisibilityBuffer::clear() {
  for_each_band(true, [&](int32_t first, int32_t last) {
    for (int32_t y = first; y <= last; ++y) std::ranges::fill(depths_.row(y), 0u);
  });
  tiles_.clear();
  table_.clear();
}

float VisibilityBuffer::depth(int x, int y) const { return std::bit_cast<float>(depths_.at(x, y)); }

std::optional<SlotTable::Triangle> VisibilityBuffer::triangle(int x, int y) const {
  if (depths_.at(x, y) == 0) return std::nullopt;
  return table_.find(slots_.at(x, y));
}

void VisibilityBuffer::draw(const GeometryTerms& terms, std::span<const PlacedStretch> stretches) {
  for (const PlacedStretch& stretch : stretches) {
    for (uint32_t first = 0; first < stretch.triangle_count;) {
      if (table_.left() == 0) {
        draw_batch(terms);
        table_.compact(depths_, slots_);
      }
      const uint32_t count = static_cast<uint32_t>(
          std::min<uint64_t>({stretch.triangle_count - first, table_.left(), batch_size}));
      number(stretch, first, count);
      first += count;
      if (batch_triangles_ >= batch_size) draw_batch(terms);
    }
  }
  draw_batch(terms);
}

void VisibilityBuffer::draw_caps(const GeometryTerms& terms, std::span<const PlacedCapRun> runs,
                                 CapCounters& counters) {
  if (runs.empty()) return;
  if (!nothing_) nothing_.emplace(width_, height_);
  counters.make_room(width_, height_);
  uint32_t next = 0;  // number of a triangle of its surface, where there are no slots
  for (size_t i = 0; i < runs.size(); ++i) {
    const PlacedCapRun& run = runs[i];
    if (run.is_first) {
      next = 0;
      uint64_t triangles = 0;
      for (size_t k = i; k == i || (k < runs.size() && !runs[k].is_first); ++k)
        triangles += runs[k].stretch.triangle_count;
      if (!depth_alone_ && table_.left() < triangles) {
        draw_cap_batch(terms, counters);
        table_.compact(depths_, slots_);
      }
    }
    DrawnRange& range = number(run.stretch, 0, run.stretch.triangle_count, true);
    if (depth_alone_) range.first_slot = next;
    next += run.stretch.triangle_count;
    cap_runs_.push_back({nullptr, nullptr, run.is_drawn, run.is_first, run.is_last});
    if (batch_triangles_ >= batch_size) draw_cap_batch(terms, counters);
  }
  draw_cap_batch(terms, counters);
}

void VisibilityBuffer::draw_cap_batch(const GeometryTerms& terms, CapCounters& counters) {
  if (batch_.empty()) return;
  DepthSource nothing = source();
  nothing_->hand_out(nothing);
  const bool side_by_side = make_batch(terms, nothing);
  for (size_t i = 0; i < batch_.size(); ++i) {
    cap_runs_[i].range = &batch_[i].range;
    cap_runs_[i].triangles = &triangles_[i];
  }
  const FillTarget into = target();
  for_each_band(side_by_side, [&](int32_t first, int32_t last) {
    fill_caps(terms, cap_runs_, first, last, counters, into);
    tiles_.refresh_rows(depths_, first, last);
  });
  tiles_.refresh_blocks();
  batch_.clear();
  cap_runs_.clear();
  batch_triangles_ = 0;
}

DrawnRange& VisibilityBuffer::number(const PlacedStretch& stretch, uint32_t first, uint32_t count,
                                     bool caps) {
  DrawnRange range{.rank = stretch.rank,
                   .part = stretch.part,
                   .first_triangle = stretch.first_triangle + first,
                   .triangle_count = count,
                   .front = stretch.front,
                   .cut = stretch.cut,
                   .caps = caps,
                   .cut_out = stretch.cut_out,
                   .chunk = stretch.chunk,
                   .placed = stretch.placed};
  if (!depth_alone_) range.first_slot = table_.add(range);
  batch_.push_back({range, stretch.pieces});
  batch_triangles_ += count;
  return batch_.back().range;
}

bool VisibilityBuffer::make_batch(const GeometryTerms& terms, const DepthSource& drawn) {
  if (triangles_.size() < batch_.size()) triangles_.resize(batch_.size());
  const bool side_by_side = thread_count() > 1 && batch_triangles_ >= worth_sharing;
  const auto make = [&](size_t i) {
    const FloatState state;
    make_triangles(terms, batch_[i].range, batch_[i].pieces, drawn, triangles_[i]);
  };
  if (side_by_side) {
    parallel_for(batch_.size(), make);
  } else {
    for (size_t i = 0; i < batch_.size(); ++i) make(i);
  }
  for (size_t i = 0; i < batch_.size(); ++i) {
    if (triangles_[i].bottom <= triangles_[i].top) tiles_.touch_rows(triangles_[i].bottom, triangles_[i].top);
  }
  return side_by_side;
}

void VisibilityBuffer::draw_batch(const GeometryTerms& terms) {
  if (batch_.empty()) return;
  const DepthSource drawn = source();
  const bool side_by_side = make_batch(terms, drawn);
  sort_large();
  for_each_band(side_by_side, [&](int32_t first, int32_t last) {
    fill_rows(first, last);
    tiles_.refresh_rows(depths_, first, last);
  });
  tiles_.refresh_blocks();
  batch_.clear();
  batch_triangles_ = 0;
}

void VisibilityBuffer::for_each_band(bool side_by_side,
                                     const std::function<void(int32_t, int32_t)>& body) const {
  const int32_t tiles = (height_ + tile_rows - 1) / tile_rows;
  const int32_t bands = side_by_side ? std::min(tiles, static_cast<int32_t>(thread_count()) * 4) : 1;
  const auto visit = [&](size_t i) {
    const FloatState state;
    const auto band = static_cast<int32_t>(i);
    body(tiles * band / bands * tile_rows, std::min(tiles * (band + 1) / bands * tile_rows, height_) - 1);
  };
  if (bands > 1) {
    parallel_for(static_cast<size_t>(bands), visit, affinity_);
  } else {
    visit(0);
  }
}

void VisibilityBuffer::sort_large() {
  large_.clear();
  const auto add = [&](const FillTriangle& triangle) {
    large_.push_back({triangle.low + triangle.high, &triangle});
  };
  for (size_t i = 0; i < batch_.size(); ++i) {
    for (const WindowTriangle& triangle : triangles_[i].large) add(triangle);
    for (const FillTriangle& triangle : triangles_[i].kernel.wide()) add(triangle);
  }
  std::sort(large_.begin(), large_.end(),
            [](const LargeTriangle& a, const LargeTriangle& b) { return a.depth > b.depth; });
}

FillTarget VisibilityBuffer::target() {
  FillTarget target{};
  target.width = width_;
  target.height = height_;
  target.stride = depths_.stride();
  target.depths = depths_.data();
  target.slots = depth_alone_ ? nullptr : slots_.data();
  tiles_.hand_out(target);
  target.order = &table_;
  target.precedes = [](const void* order, uint32_t slot, uint32_t other) {
    return static_cast<const SlotTable*>(order)->precedes(slot, other);
  };
  return target;
}

DepthSource VisibilityBuffer::source() const {
  DepthSource source{};
  source.width = width_;
  source.height = height_;
  source.stride = depths_.stride();
  source.depths = depths_.data();
  tiles_.hand_out(source);
  return source;
}

[[gnu::noinline]] void VisibilityBuffer::fill_rows(int32_t first, int32_t last) {
  const RasterKernels* const kernels = raster_kernels(instruction_set());
  const FillTarget into = target();
  const auto fill_one = [&](const FillTriangle& triangle) {
    const int32_t bottom = std::max(triangle.bottom, first), top = std::min(triangle.top, last);
    if (bottom > top) return;
    if (kernels != nullptr) {
      kernels->fill(triangle, bottom, top, into);
    } else {
      tiles_.mark(triangle.left, triangle.right, bottom, top);
      fill(triangle, bottom, top, into);
    }
  };
  for (const LargeTriangle& large : large_) fill_one(*large.triangle);
  for (size_t i = 0; i < batch_.size(); ++i) {
    const StretchTriangles& stretch = triangles_[i];
    if (stretch.bottom > last || stretch.top < first) continue;
    for (const WindowTriangle& triangle : stretch.small) fill_one(triangle);
    for (const CutOutTriangle& triangle : stretch.cut_out) {
      const int32_t bottom = std::max(triangle.window.bottom, first),
                    top = std::min(triangle.window.top, last);
      if (bottom > top) continue;
      tiles_.mark(triangle.window.left, triangle.window.right, bottom, top);
      fill_cut_out(triangle, bottom, top, into);
    }
    for (const NarrowTriangles& narrow : stretch.kernel.narrow()) {
      if (narrow.lowest_row <= last && narrow.highest_row >= first)
        kernels->fill_narrow(narrow, first, last, into);
    }
    if (const int32_t count = stretch.kernel.fragment_count(); count > 0)
      kernels->fill_fragments(stretch.kernel.fragments(), count, first, last, into);
  }
}

}  // namespace triptych
