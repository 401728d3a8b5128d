#include "report/scatter_chart.hpp"

#include "report/chart.hpp"
#include "report/html.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <limits>

namespace triptych {

namespace {

// The drawing's own units; the page scales them.
constexpr double width = 640, height = 300, left = 64, right = 20, top = 40, bottom = 40;
constexpr int steps = 5;

struct Axes {
  double first = 1, last = 10;  ///< of x
  double y_limit = 1;
  double x(double value) const {
    return left + (width - left - right) * std::log(value / first) / std::log(last / first);
  }
  double y(double value) const { return height - bottom - (height - top - bottom) * value / y_limit; }
};

/// 1, 2 or 5 × 10ⁿ: those that are marked on a logarithmic axis.
std::vector<double> marks(double first, double last) {
  std::vector<double> values;
  for (double power = std::pow(10, std::floor(std::log10(first))); power <= last; power *= 10) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      if (factor * power >= first && factor * power <= last) values.push_back(factor * power);
    }
  }
  return values;
}

Axes axes_of(const ScatterChart& chart) {
  double first = std::numeric_limits<double>::max(), last = 0, y = 0;
  for (const ScatterSeries& series : chart.series) {
    for (const ScatterSeries::Point& point : series.points) {
      first = std::min(first, point.x);
      last = std::max(last, point.x);
      y = std::max(y, point.y);
    }
  }
  if (!(last > 0)) return {};
  constexpr double room = 1.3;  // around the points
  return {first / room, last * room, axis_limit(y)};
}

/// Whether no other point has less of one and no more of the other.
bool is_best(const ScatterChart& chart, const ScatterSeries::Point& point) {
  for (const ScatterSeries& series : chart.series) {
    for (const ScatterSeries::Point& other : series.points) {
      if (other.x <= point.x && other.y <= point.y && (other.x < point.x || other.y < point.y)) return false;
    }
  }
  return true;
}

std::string draw(const Axes& axes, const ScatterChart& chart) {
  std::string svg;
  for (int i = 0; i <= steps; ++i) {
    const double y = axes.y_limit * i / steps;
    svg += fmt::format("<line class=\"grid\" x1=\"{:.0f}\" x2=\"{:.0f}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>", left,
                       width - right, axes.y(y), axes.y(y));
    svg += fmt::format("<text class=\"label end\" x=\"{:.0f}\" y=\"{:.1f}\">{:.4g}</text>", left - 8,
                       axes.y(y) + 4, y);
  }
  for (const double x : marks(axes.first, axes.last)) {
    svg += fmt::format("<text class=\"label middle\" x=\"{:.1f}\" y=\"{:.0f}\">{:g}</text>", axes.x(x),
                       height - bottom + 18, x);
  }
  svg += fmt::format("<text class=\"label end\" x=\"{:.0f}\" y=\"{:.0f}\">{}</text>", width - right,
                     height - 4, escape_html(chart.x_unit));
  return svg + fmt::format("<text class=\"label\" x=\"4\" y=\"14\">{}</text>", escape_html(chart.y_unit));
}

std::string draw(const Axes& axes, const ScatterChart& chart, const ScatterSeries& series, size_t color) {
  std::string points, circles;
  for (const ScatterSeries::Point& point : series.points) {
    const double x = axes.x(point.x), y = axes.y(point.y);
    points += fmt::format("{:.1f},{:.1f} ", x, y);
    circles += fmt::format(
        "<circle class=\"series-{}{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\"><title>{}</title></circle>",
        color, is_best(chart, point) ? " best" : "", x, y, escape_html(point.says));
    circles += fmt::format("<text class=\"label\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", x + 6, y - 5,
                           escape_html(point.label));
  }
  return fmt::format("<polyline class=\"series-{}\" points=\"{}\"/>", color, points) + circles;
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
    svg += draw(axes, chart, series, color);
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
