#include "report/scatter_chart.hpp"

#include "report/chart.hpp"
#include "report/html.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <limits>
#include <vector>

namespace triptych {

namespace {

// The drawing's own units; the page scales them.
constexpr double width = 640, plot_height = 220, left = 64, right = 20, bottom = 40;
constexpr double letter = 7.2;  ///< about as wide as a letter of a label
constexpr double text_height = 12, legend_row = 16, legend_mark = 24;

struct Axes {
  double first = 1, last = 10;  ///< of x
  double y_limit = 1;
  double top = 40;  ///< below the legend
  double height() const { return top + plot_height + bottom; }
  double x(double value) const {
    return left + (width - left - right) * std::log(value / first) / std::log(last / first);
  }
  double y(double value) const { return top + plot_height - plot_height * value / y_limit; }
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
  constexpr double room = 1.3, headroom = 1.06;  // around the points
  return {.first = first / room, .last = last * room, .y_limit = axis_limit(headroom * y)};
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
  for (const double y : axis_marks(axes.y_limit)) {
    svg += fmt::format("<line class=\"grid\" x1=\"{:.0f}\" x2=\"{:.0f}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>", left,
                       width - right, axes.y(y), axes.y(y));
    svg += fmt::format("<text class=\"label end\" x=\"{:.0f}\" y=\"{:.1f}\">{:.4g}</text>", left - 8,
                       axes.y(y) + 4, y);
  }
  for (const double x : marks(axes.first, axes.last)) {
    svg += fmt::format("<text class=\"label middle\" x=\"{:.1f}\" y=\"{:.0f}\">{:g}</text>", axes.x(x),
                       axes.height() - bottom + 18, x);
  }
  svg += fmt::format("<text class=\"label end\" x=\"{:.0f}\" y=\"{:.0f}\">{}</text>", width - right,
                     axes.height() - 4, escape_html(chart.x_unit));
  return svg + fmt::format("<text class=\"label\" x=\"4\" y=\"14\">{}</text>", escape_html(chart.y_unit));
}

/// How a series differs from the others: colours first, then shapes and dashes.
struct Style {
  explicit Style(size_t index) : color(index % series_colors + 1), round(index / series_colors) {}
  /// One marker around a point; `best`: filled.
  std::string marker(double x, double y, bool best, const std::string& says) const {
    const std::string title = says.empty() ? "" : fmt::format("<title>{}</title>", escape_html(says));
    const std::string name = fmt::format("class=\"mark series-{}{}\"", color, best ? " best" : "");
    switch (round % 4) {
      case 0:
        return fmt::format("<circle {} cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\">{}</circle>", name, x, y, title);
      case 1:
        return path(name, "-3.2,-3.2h6.4v6.4h-6.4z", x, y, title);  // a square
      case 2:
        return path(name, "0,-4.4l4.2,7.4h-8.4z", x, y, title);  // a triangle
      default:
        return path(name, "0,-4.6l4.6,4.6l-4.6,4.6l-4.6,-4.6z", x, y, title);  // a diamond
    }
  }
  /// The attribute of its lines; longer dashes in every further round of colours.
  std::string dashes() const {
    return round == 0 ? "" : fmt::format(" stroke-dasharray=\"{} 3\"", 3 * round);
  }
  size_t color, round;

 private:
  static std::string path(const std::string& name, const char* shape, double x, double y,
                          const std::string& title) {
    return fmt::format("<path {} transform=\"translate({:.1f},{:.1f})\" d=\"M{}\">{}</path>", name, x, y,
                       shape, title);
  }
};

std::string draw(const Axes& axes, const ScatterChart& chart, const ScatterSeries& series,
                 const Style& style) {
  std::string points, markers;
  for (const ScatterSeries::Point& point : series.points) {
    const double x = axes.x(point.x), y = axes.y(point.y);
    points += fmt::format("{:.1f},{:.1f} ", x, y);
    markers += style.marker(x, y, is_best(chart, point), point.says);
  }
  return fmt::format("<polyline class=\"series-{}\"{} points=\"{}\"/>", style.color, style.dashes(), points) +
         markers;
}

struct Box {
  double left, right, top, bottom;
  bool meets(const Box& other) const {
    return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
  }
};

/// Where a label may be around its point, the best place first.
std::array<Box, 3> places_of_label(double x, double y, const std::string& label) {
  constexpr double beside = 6, above = 5, below = 17;
  const double wide = letter * static_cast<double>(label.size());
  const auto at = [&](double from, double baseline) {
    return Box{from, from + wide, baseline - text_height, baseline};
  };
  return {at(x + beside, y - above), at(x - beside - wide, y - above), at(x + beside, y + below)};
}

/// The points' labels, those of the best points first, beside their points; one that would lie over another
/// or over a point, or outside the plot, is left out.
std::string labels(const Axes& axes, const ScatterChart& chart) {
  constexpr double apart = 3, around = 4;
  std::vector<Box> taken;
  for (const ScatterSeries& series : chart.series) {
    for (const ScatterSeries::Point& point : series.points) {
      const double x = axes.x(point.x), y = axes.y(point.y);
      taken.push_back({x - around, x + around, y - around, y + around});
    }
  }
  const auto is_free = [&](const Box& box) {
    const Box wider{box.left - apart, box.right + apart, box.top, box.bottom};
    return box.left >= left && box.right <= width && box.top >= axes.top - around &&
           box.bottom <= axes.top + plot_height &&
           std::none_of(taken.begin(), taken.end(), [&](const Box& other) { return wider.meets(other); });
  };
  std::string svg;
  for (const bool best : {true, false}) {
    for (const ScatterSeries& series : chart.series) {
      for (const ScatterSeries::Point& point : series.points) {
        if (is_best(chart, point) != best) continue;
        const auto places = places_of_label(axes.x(point.x), axes.y(point.y), point.label);
        const auto* const place = std::find_if(places.begin(), places.end(), is_free);
        if (place == places.end()) continue;
        taken.push_back(*place);
        svg += fmt::format("<text class=\"label point\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", place->left,
                           place->bottom, escape_html(point.label));
      }
    }
  }
  return svg;
}

/// The text in pieces of at most so many bytes, none of which cuts a character.
std::vector<std::string> pieces(const std::string& text, size_t most) {
  std::vector<std::string> found;
  for (size_t at = 0; at < text.size() || found.empty();) {
    size_t end = std::min(at + most, text.size());
    const auto inside = [&](size_t byte) {
      return (static_cast<unsigned char>(text[byte]) & 0xc0u) == 0x80u;
    };
    while (end < text.size() && end > at + 1 && inside(end)) --end;
    found.push_back(text.substr(at, end - at));
    at = end;
  }
  return found;
}

/// Rows of names below the chart's own, as many as they need; sets where the plot begins.
std::string legend(const ScatterChart& chart, Axes& axes) {
  constexpr double gap = 24, end = width - right;
  const auto most = static_cast<size_t>((end - left - legend_mark) / letter);
  double x = left, y = 26;
  std::string svg;
  for (size_t i = 0; i < chart.series.size(); ++i) {
    const Style style(i);
    const std::vector<std::string> lines = pieces(chart.series[i].name, most);
    const double wide = legend_mark + letter * static_cast<double>(lines.front().size());
    if (x > left && x + wide > end) x = left, y += legend_row;
    svg +=
        fmt::format("<line class=\"series-{}\"{} x1=\"{:.0f}\" x2=\"{:.0f}\" y1=\"{:.0f}\" y2=\"{:.0f}\"/>",
                    style.color, style.dashes(), x, x + 18, y, y);
    svg += style.marker(x + 9, y, false, "");
    for (const std::string& line : lines) {
      if (&line != &lines.front()) y += legend_row;
      svg += fmt::format("<text class=\"label name\" x=\"{:.0f}\" y=\"{:.0f}\">{}</text>", x + legend_mark,
                         y + 4, escape_html(line));
    }
    x += wide + gap;
  }
  axes.top = y + 14;
  return svg;
}

}  // namespace

std::string scatter_svg(const ScatterChart& chart) {
  Axes axes = axes_of(chart);
  const std::string names = legend(chart, axes);
  std::string svg = fmt::format("<svg viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\">", width, axes.height());
  svg += draw(axes, chart) + names;
  for (size_t i = 0; i < chart.series.size(); ++i) svg += draw(axes, chart, chart.series[i], Style(i));
  return svg + labels(axes, chart) + "</svg>";
}

}  // namespace triptych
