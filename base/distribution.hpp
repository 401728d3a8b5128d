// A distribution of measured values, as reports print it.
#pragma once

#include <span>

namespace triptych {

/// Mean and nearest-rank percentiles; all zero for no values.
struct Distribution {
  double mean = 0, p50 = 0, p95 = 0, p99 = 0, max = 0;
};

Distribution distribution(std::span<const double> values);

}  // namespace triptych
