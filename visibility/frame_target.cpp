#include "visibility/frame_target.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace triptych {

VisibleSet owners(std::vector<uint32_t> items) {
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
  VisibleSet ids;
  for (const uint32_t item : items) {
    if (item > 0) ids.push_back(item - 1);
  }
  return ids;
}

VisibleSet owners(const FrameTarget& target, uint32_t samples) {
  VisibleSet all = target.transparent_owners();
  for (uint32_t sample = 0; sample < samples; ++sample) {
    VisibleSet more;
    std::ranges::set_union(all, owners(target.read_items(sample)), std::back_inserter(more));
    all = std::move(more);
  }
  return all;
}

}  // namespace triptych
