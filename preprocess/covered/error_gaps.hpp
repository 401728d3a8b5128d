// Errors that levels of detail may not have, so that what is covered stays beneath what covers it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace triptych {

/// A covered surface and what covers it stay apart while both are off by at most `low`. From `high` on the
/// covered one is left out: all of it lies within that of what is left. In between a level's error is raised
/// to `high`.
struct ErrorGap {
  double low = 0, high = 0;
};

/// The least error of at least this that lies in no gap, its ends excepted.
inline double beyond_gaps(double error, const std::vector<ErrorGap>& gaps) {
  for (bool moved = true; moved;) {
    moved = false;
    for (const ErrorGap& gap : gaps) {
      if (!(error > gap.low && error < gap.high)) continue;
      error = gap.high;
      moved = true;
    }
  }
  return error;
}

/// Gaps that overlap become one; ascending.
inline void join_gaps(std::vector<ErrorGap>& gaps) {
  std::sort(gaps.begin(), gaps.end(), [](const ErrorGap& a, const ErrorGap& b) { return a.low < b.low; });
  size_t kept = 0;
  for (const ErrorGap& gap : gaps) {
    if (kept > 0 && gap.low < gaps[kept - 1].high) {
      gaps[kept - 1].high = std::max(gaps[kept - 1].high, gap.high);
    } else {
      gaps[kept++] = gap;
    }
  }
  gaps.resize(kept);
}

/// Joins them only where there is no room for another: join_gaps() follows.
inline void add_gap(const ErrorGap& gap, std::vector<ErrorGap>& gaps) {
  if (gaps.size() == gaps.capacity()) join_gaps(gaps);
  gaps.push_back(gap);
}

/// Adds gaps, times `factor`; join_gaps() follows.
inline void add_gaps(const std::vector<ErrorGap>& added, double factor, std::vector<ErrorGap>& gaps) {
  for (const ErrorGap& gap : added) add_gap({gap.low * factor, gap.high * factor}, gaps);
}

/// Classes of distances, eight an octave: the first that is no less than so many lattice steps, at least 1
/// and at most 255; and the distance of a class.
inline double distance_of_class(uint32_t of_class) {
  constexpr double eighths[] = {1,
                                1.0905077326652577,
                                1.189207115002721,
                                1.2968395546510096,
                                1.4142135623730951,
                                1.5422108254079407,
                                1.681792830507429,
                                1.8340080864093424};
  return eighths[of_class % 8] * static_cast<double>(uint64_t{1} << of_class / 8);
}
inline uint32_t class_of_distance(double steps) {
  uint32_t of_class = 1;
  while (of_class < 255 && distance_of_class(of_class) < steps) ++of_class;
  return of_class;
}

}  // namespace triptych
