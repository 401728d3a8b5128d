#include "render/gl/device_space.hpp"

#include <iterator>

namespace triptych {

void DeviceSpace::grow(uint64_t size) {
  if (size == size_) return;
  const uint64_t before = size_;
  size_ = size;
  give_back(before, size - before);
}

std::optional<uint64_t> DeviceSpace::take(uint64_t bytes, uint64_t alignment) {
  for (auto gap = gaps_.begin(); gap != gaps_.end(); ++gap) {
    const auto [begin, end] = *gap;
    const uint64_t first = (begin + alignment - 1) / alignment * alignment;
    if (first + bytes > end) continue;
    gaps_.erase(gap);
    if (begin < first) gaps_.emplace(begin, first);
    if (first + bytes < end) gaps_.emplace(first + bytes, end);
    return first;
  }
  return std::nullopt;
}

void DeviceSpace::give_back(uint64_t offset, uint64_t bytes) {
  uint64_t end = offset + bytes;
  auto after = gaps_.lower_bound(offset);
  if (after != gaps_.end() && after->first == end) {
    end = after->second;
    after = gaps_.erase(after);
  }
  if (after != gaps_.begin() && std::prev(after)->second == offset) {
    std::prev(after)->second = end;
  } else {
    gaps_.emplace(offset, end);
  }
}

}  // namespace triptych
