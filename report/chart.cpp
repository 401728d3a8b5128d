#include "report/chart.hpp"

#include "base/distribution.hpp"
#include "report/html.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <limits>

namespace triptych {

namespace {

// The drawing's own units; the page scales them.
constexpr double width = 640, height = 250, left = 56, right = 14, top = 34, bottom = 34;
constexpr double plot_width = width - left - right, plot_height = height - top - bottom;

double axis_step(double value) {
  if (!(value > 0)) return 1;
  constexpr double max_steps = 5;
  const double power = std::pow(10, std::floor(std::log10(value / max_steps)));
  for (const double factor : {1.0, 2.0, 2.5, 5.0}) {
    if (factor * power * max_steps >= value) return factor * power;
  }
  return 10 * power;
}

struct Scale {
  size_t frames = 0;
  double limit = 1;
  double foot = 0;  ///< the lowest value; above 0 the scale is logarithmic, and both are powers of ten
  double x(size_t frame) const {
    return left +
           plot_width * static_cast<double>(frame) / static_cast<double>(std::max<size_t>(2, frames) - 1);
  }
  double share(double value) const {
    return foot > 0 ? std::log10(std::max(value, foot) / foot) / std::log10(limit / foot) : value / limit;
  }
  double y(double value) const { return top + plot_height * (1 - std::clamp(share(value), 0.0, 1.0)); }
  /// The values at which lines are drawn.
  std::vector<double> marks() const {
    if (!(foot > 0)) return axis_marks(limit);
    std::vector<double> values;
    for (double value = foot; value <= limit * 1.001; value *= 10) values.push_back(value);
    return values;
  }
};

struct Extent {
  Scale scale;
  size_t cut_off = 0;
  double highest = 0;
};

/// Powers of ten around all values above 0.
Extent magnitudes_of(const LineChart& chart) {
  Extent extent;
  double least = std::numeric_limits<double>::infinity();
  for (const ChartSeries& series : chart.series) {
    extent.scale.frames = std::max(extent.scale.frames, series.values.size());
    for (const double value : series.values) {
      if (!(value > 0)) continue;
      least = std::min(least, value);
      extent.highest = std::max(extent.highest, value);
    }
  }
  if (!(extent.highest > 0)) least = extent.highest = 1;
  extent.scale.foot = std::pow(10, std::floor(std::log10(least)));
  extent.scale.limit =
      std::max(10 * extent.scale.foot, std::pow(10, std::ceil(std::log10(extent.highest) - 1e-9)));
  return extent;
}

Extent extent_of(const LineChart& chart) {
  if (chart.logarithmic) return magnitudes_of(chart);
  Extent extent;
  double typical = 0;
  for (const ChartSeries& series : chart.series) {
    const Distribution values = distribution(series.values);
    extent.scale.frames = std::max(extent.scale.frames, series.values.size());
    extent.highest = std::max(extent.highest, values.max);
    typical = std::max(typical, values.p99);
  }
  constexpr double towering = 1.6;
  extent.scale.limit = axis_limit(extent.highest > towering * typical ? typical : extent.highest);
  for (const ChartSeries& series : chart.series) {
    extent.cut_off +=
        static_cast<size_t>(std::count_if(series.values.begin(), series.values.end(),
                                          [&](double value) { return value > extent.scale.limit; }));
  }
  return extent;
}

std::string axes(const Scale& scale, const std::string& unit) {
  std::string svg;
  for (const double value : scale.marks()) {
    svg += fmt::format("<line class=\"grid\" x1=\"{:.0f}\" x2=\"{:.0f}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>", left,
                       width - right, scale.y(value), scale.y(value));
    svg += fmt::format("<text class=\"label end\" x=\"{:.0f}\" y=\"{:.1f}\">{:g}</text>", left - 8,
                       scale.y(value) + 4, value);
  }
  constexpr size_t marks = 6;
  const size_t stride =
      std::max<size_t>(1, static_cast<size_t>(axis_step(static_cast<double>(scale.frames) * 5 / marks)));
  for (size_t frame = 0; frame < scale.frames; frame += stride) {
    svg += fmt::format("<text class=\"label middle\" x=\"{:.1f}\" y=\"{:.0f}\">{}</text>", scale.x(frame),
                       height - bottom + 18, frame);
  }
  svg += fmt::format("<text class=\"label end\" x=\"{:.0f}\" y=\"{:.0f}\">frame</text>", width - right,
                     height - 2);
  return svg + fmt::format("<text class=\"label\" x=\"{:.0f}\" y=\"14\">{}</text>", 4.0, escape_html(unit));
}

std::string line(const ChartSeries& series, size_t index, const Scale& scale) {
  std::string points;
  for (size_t i = 0; i < series.values.size(); ++i) {
    points += fmt::format("{:.1f},{:.1f} ", scale.x(i), scale.y(series.values[i]));
  }
  return fmt::format("<polyline class=\"series-{}\" points=\"{}\"><title>{}</title></polyline>", index + 1,
                     points, escape_html(series.name));
}

}  // namespace

double axis_limit(double value) {
  const double step = axis_step(value);
  return value > 0 ? step * std::ceil(value / step - 1e-9) : 1;
}

std::vector<double> axis_marks(double limit) {
  std::vector<double> values;
  const double step = axis_step(limit);
  for (int i = 0; i * step <= limit * 1.001; ++i) values.push_back(i * step);
  return values;
}

std::string chart_svg(const LineChart& chart) {
  const Extent extent = extent_of(chart);
  std::string svg = fmt::format("<svg viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\">", width, height);
  svg += axes(extent.scale, chart.unit);
  double legend = left + 90;
  for (size_t i = 0; i < chart.series.size(); ++i) {
    const ChartSeries& series = chart.series[i];
    svg += line(series, i, extent.scale);
    svg += fmt::format("<line class=\"series-{}\" x1=\"{:.0f}\" x2=\"{:.0f}\" y1=\"10\" y2=\"10\"/>", i + 1,
                       legend, legend + 18);
    svg += fmt::format("<text class=\"label\" x=\"{:.0f}\" y=\"14\">{}</text>", legend + 24,
                       escape_html(series.name));
    constexpr double letter = 6.6;
    legend += 48 + letter * static_cast<double>(series.name.size());
  }
  if (extent.cut_off > 0) {
    svg +=
        fmt::format("<text class=\"label\" x=\"{:.0f}\" y=\"{:.0f}\">{} above the scale, up to {:.0f}</text>",
                    left, height - 2, extent.cut_off, extent.highest);
  }
  return svg + "</svg>";
}

}  // namespace triptych
