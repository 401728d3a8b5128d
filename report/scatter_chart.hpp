// A chart of points over two axes as SVG, which takes its colours from the page around it as line charts do.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace triptych {

/// Points that belong together, joined in their order; each with what it says when pointed at.
struct ScatterSeries {
  struct Point {
    double x = 0, y = 0;
    std::string label;  ///< next to the point
    std::string says;   ///< when it is pointed at
  };
  std::string name;
  std::vector<Point> points;
};

struct ScatterChart {
  std::string x_unit, y_unit;
  std::vector<ScatterSeries> series{};
};

/// One <svg> element: x > 0 on a logarithmic axis, y from zero. Points that no other one beats, with less of
/// both, are filled (the Pareto front). The names of series stand above in as many rows as they need; series
/// beyond the colours that there are have other shapes and dashes, and labels that would lie over others are
/// left out.
std::string scatter_svg(const ScatterChart& chart);

}  // namespace triptych
