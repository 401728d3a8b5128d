// Line charts as SVG that takes its colours from the page around it (classes `series-1` …, `grid`, `label`).
#pragma once

#include <string>
#include <vector>

namespace triptych {

struct ChartSeries {
  std::string name;
  std::vector<double> values;  ///< one per frame
};

struct LineChart {
  std::string unit;  ///< of the vertical axis, which starts at zero, or at a power of ten
  std::vector<ChartSeries> series;
  bool logarithmic =
      false;  ///< the vertical axis, where series differ by magnitudes; values up to 0 lie at its foot
};

/// The smallest axis limit that is not below value, as at most five steps of 1, 2, 2.5 or 5 × 10ⁿ; 1 for
/// values up to 0.
double axis_limit(double value);
/// The values that are marked on an axis from 0 to such a limit.
std::vector<double> axis_marks(double limit);

/// One <svg> element. Where a few values are far above the 99th percentile the axis ends below them, and the
/// chart says how many are cut off and how high they are.
std::string chart_svg(const LineChart& chart);

}  // namespace triptych
