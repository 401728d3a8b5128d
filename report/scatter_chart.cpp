#include "report/scatter_chart.hpp"

#include "report/chart.hpp"
#include "report/html.hpp"

#include <algorithm>
#include <fmt/core.h>

namespace triptych {

namespace {

// The drawing's own units; the page scales them.
constexpr double width = 640, height = 300, left = 64, right = 20, top = 40, bottom = 40;
constexpr int steps = 5;

struct Axes {
  double x_limit = 1, y_limit = 1;
  double x(double value) const { return left + (width - left - right) * value / x_limit; }
  double y(double value) const { return height - bottom - (height - top - bottom) * value / y_limit; }
};

Axes axes_of(const ScatterChart& chart) {
  double x = 0, y = 0;
  for (const ScatterSeries& series : chart.series) {
    for (const ScatterSeries::Point& point : series.points)
      x = std::max(x, point.x), y = std::max(y, point.y);
  }
  return {axis_limit(x), axis_limit(y)};
}

std::string draw(const Axes& axes, const ScatterChart& chart) {
  std::string svg;
  for (int i = 0; i <= steps; ++i) {
    const double x = axes.x_limit * i / steps, y = axes.y_limit * i / steps;
    svg += fmt::format("<line class=\"grid\" x1=\"{:.0f}\" x2=\"{:.0f}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>", left,
                       width - right, axes.y(y), axes.y(y));
    svg += fmt::format("<text class=\"label end\" x=\"{:.0f}\" y=\"{:.1f}\">{:.4g}</text>", left - 8,
                       axes.y(y) + 4, y);
    svg += fmt::format("<text class=\"label middle\" x=\"{:.1f}\" y=\"{:.0f}\">{:.4g}</text>", axes.x(x),
                       height - bottom + 18, x);
  }
  svg += fmt::format("<text class=\"label end\" x=\"{:.0f}\" y=\"{:.0f}\">{}</text>", width - right,
                     height - 4, escape_html(chart.x_unit));
  return svg + fmt::format("<text class=\"label\" x=\"4\" y=\"14\">{}</text>", escape_html(chart.y_unit));
}

std::string draw(const Axes& axes, const ScatterSeries& series, size_t color) {
  std::string points, marks;
  for (const ScatterSeries::Point& point : series.points) {
    const double x = axes.x(point.x), y = axes.y(point.y);
    points += fmt::format("{:.1f},{:.1f} ", x, y);
    marks += fmt::format(
        "<circle class=\"series-{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\"><title>{}</title></circle>", color,
        x, y, escape_html(point.says));
    marks += fmt::format("<text class=\"label\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", x + 6, y - 5,
                         escape_html(point.label));
  }
  return fmt::format("<polyline class=\"series-{}\" points=\"{}\"/>", color, points) + marks;
}

}  // namespace

std::string scatter_svg(const ScatterChart& chart) {
  const Axes axes = axes_of(chart);
  std::string svg = fmt::format("<svg viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\">", width, height);
  svg += draw(axes, chart);
  double legend = left;
  for (size_t i = 0; i < chart.series.size(); ++i) {
    const ScatterSeries& series = chart.series[i];
    const size_t color = i % series_colors + 1;
    svg += draw(axes, series, color);
    svg += fmt::format("<line class=\"series-{}\" x1=\"{:.0f}\" x2=\"{:.0f}\" y1=\"26\" y2=\"26\"/>", color,
                       legend, legend + 18);
    svg += fmt::format("<text class=\"label\" x=\"{:.0f}\" y=\"30\">{}</text>", legend + 24,
                       escape_html(series.name));
    constexpr double letter = 6.6;
    legend += 48 + letter * static_cast<double>(series.name.size());
  }
  return svg + "</svg>";
}

}  // namespace triptych
