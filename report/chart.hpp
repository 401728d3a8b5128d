// Line charts as SVG that takes its colours from the page around it (classes `series-1` …, `grid`, `label`).
#pragma once

#include <string>
#include <vector>

namespace triptych {

struct ChartSeries {
  std::string name;
  std::vector<double> values;  ///< one a frame
};

struct LineChart {
  std::string unit;  ///< of the vertical axis, which starts at zero
  std::vector<ChartSeries> series;
};

/// The least of 1, 2, 2.5, 5 × 10ⁿ times a whole number of steps, at most five, that holds value; 1 for
/// nothing above 0.
double axis_limit(double value);

/// One <svg> element. Where a few values tower above the 99th percentile the axis stops below them, and the
/// chart says how many are cut off and how high they went.
std::string chart_svg(const LineChart& chart);

}  // namespace triptych
