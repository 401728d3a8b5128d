#include "raster/slots.hpp"

#include <algorithm>
#include <cassert>
#include <tuple>

namespace triptych {

void SlotTable::clear() {
  next_slot_ = 0;
  compacted_ = 0;
  kept_.clear();
  ranges_.clear();
}

uint32_t SlotTable::add(DrawnRange range) {
  assert(range.triangle_count <= left());
  range.first_slot = static_cast<uint32_t>(next_slot_);
  next_slot_ += range.triangle_count;
  ranges_.push_back(range);
  return range.first_slot;
}

size_t SlotTable::range_of(uint32_t slot) const {
  const auto after =
      std::upper_bound(ranges_.begin() + static_cast<std::ptrdiff_t>(compacted_), ranges_.end(), slot,
                       [](uint32_t value, const DrawnRange& range) { return value < range.first_slot; });
  return static_cast<size_t>(after - ranges_.begin()) - 1;
}

SlotTable::Kept SlotTable::name_of(uint32_t slot) const {
  if (slot < kept_.size()) return kept_[slot];
  const size_t range = range_of(slot);
  return {static_cast<uint32_t>(range), ranges_[range].first_triangle + (slot - ranges_[range].first_slot)};
}

SlotTable::Triangle SlotTable::find(uint32_t slot) const {
  const Kept name = name_of(slot);
  return {&ranges_[name.range], name.triangle};
}

SlotTable::Triangle SlotTable::find(uint32_t slot, size_t& range) const {
  if (slot < kept_.size()) return find(slot);
  const auto is_in = [&](size_t which) {
    return which >= compacted_ && which < ranges_.size() &&
           slot - ranges_[which].first_slot < ranges_[which].triangle_count;
  };
  if (!is_in(range)) range = range_of(slot);
  return {&ranges_[range], ranges_[range].first_triangle + (slot - ranges_[range].first_slot)};
}

bool SlotTable::precedes(uint32_t slot, uint32_t other) const {
  const auto key = [&](uint32_t of) {
    const Triangle found = find(of);
    return std::tuple(found.range->chunk->layer(found.triangle), found.range->rank, found.range->part,
                      found.triangle, !found.range->caps);
  };
  return key(slot) < key(other);
}

void SlotTable::compact(const PixelPlane& depths, PixelPlane& slots) {
  const auto for_each_slot = [&](const auto& visit) {
    for (int y = 0; y < slots.height(); ++y) {
      const auto held = depths.row(y);
      const auto row = slots.row(y);
      for (size_t x = 0; x < row.size(); ++x) {
        if (held[x] != 0) visit(row[x]);
      }
    }
  };
  scratch_.clear();
  for_each_slot([&](uint32_t slot) { scratch_.push_back(slot); });
  std::sort(scratch_.begin(), scratch_.end());
  scratch_.erase(std::unique(scratch_.begin(), scratch_.end()), scratch_.end());
  std::vector<Kept> kept;
  for (const uint32_t slot : scratch_) kept.push_back(name_of(slot));
  for_each_slot([&](uint32_t& slot) {
    const auto at = std::lower_bound(scratch_.begin(), scratch_.end(), slot);
    slot = static_cast<uint32_t>(at - scratch_.begin());
  });
  kept_ = std::move(kept);
  compacted_ = ranges_.size();
  next_slot_ = kept_.size();
}

}  // namespace triptych
