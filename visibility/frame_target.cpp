#include "visibility/frame_target.hpp"

#include <algorithm>

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

}  // namespace triptych
