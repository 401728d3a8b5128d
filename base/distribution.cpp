#include "base/distribution.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace triptych {

Distribution distribution(std::span<const double> values) {
  if (values.empty()) return {};
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const auto at = [&](double share) {
    const auto rank = static_cast<size_t>(std::ceil(share * static_cast<double>(sorted.size())));
    return sorted[std::clamp<size_t>(rank, 1, sorted.size()) - 1];
  };
  const double sum = std::accumulate(sorted.begin(), sorted.end(), 0.0);
  return {sum / static_cast<double>(sorted.size()), at(0.50), at(0.95), at(0.99), sorted.back()};
}

}  // namespace triptych
