#include "report/accuracy_page.hpp"

#include "report/accuracy_pictures_html.hpp"
#include "report/accuracy_series.hpp"
#include "report/html.hpp"
#include "report/scatter_chart.hpp"

#include <array>
#include <fmt/core.h>
#include <map>

namespace triptych {

using nlohmann::json;

namespace {

/// An error that is drawn against time: where it is in a row, and what it means.
struct Measure {
  const char* pointer;
  const char* name;
  double at_zero, scale;  ///< at_zero + scale · figure is drawn
  const char* meaning;
};
/// A row's figure; null where it was not measured, and for the cover of so few pixels that it says nothing.
json figure(const json& row, const std::string& pointer) {
  constexpr double least_cover_pixels = 100;
  const bool is_cover = pointer == "/cover_kept";
  if (is_cover && row.value("cover_pixels", 0.0) < least_cover_pixels) return nullptr;
  return row.at(json::json_pointer(pointer));
}

constexpr std::array measures = {
    Measure{"/deviation_px/max", "largest deviation, pixels", 0, 1,
            "How far any surface is from where it should be, on the screen."},
    Measure{"/wrong_pixel_share", "pixels that differ, %", 0, 100,
            "Pixels that differ from the picture of the full detail, by whatever little."},
    Measure{"/hole_share", "holes, pixels a million", 0, 1e6,
            "Background where the reference shows surfaces all round."},
    Measure{"/swap_share", "swaps, pixels a million", 0, 1e6,
            "Objects or colours that the reference shows nowhere near: what lay hidden comes through."},
    Measure{"/cover_kept", "cover of small things lost, %", 100, -100,
            "Of the pixels that things of at most 8 pixels cover, averaged over shifts of the camera."},
    Measure{"/popping", "popping, of 255", 0, 1,
            "Change from frame to frame beyond the reference's own change; the mean over pixels."},
    Measure{"/shade/p99", "shade inside surfaces, 99th percentile of 255", 0, 1,
            "How much lighter or darker smooth surfaces are, where the same colour shows: facets of coarse "
            "levels."},
    Measure{"/rmse", "colour error (RMSE), of 255", 0, 1,
            "The root of the mean squared difference of colours."},
    Measure{"/ssim", "structural dissimilarity (1 - SSIM)", 1, -1, "0 where the pictures are alike."},
    Measure{"/butteraugli", "butteraugli, 3-norm", 0, 1,
            "A perceptual distance of pictures; 0 where they are alike."},
    Measure{"/missed_triangle_share", "triangles in view left out, %", 0, 100,
            "Of drawables that own a pixel and were not drawn."},
};

ScatterChart chart_of(const json& rows, const Measure& measure) {
  ScatterChart chart{.x_unit = "median frame time, ms", .y_unit = measure.name};
  std::map<std::string, size_t> places;
  for (const json& row : rows) {
    const json value = figure(row, measure.pointer);
    if (!value.is_number()) continue;
    const std::string name = series_name(row, rows);
    const auto [place, is_new] = places.emplace(name, chart.series.size());
    if (is_new) chart.series.push_back({name, {}});
    const std::string error = fmt::format("{:g}", row["pixel_error"].get<double>());
    chart.series[place->second].points.push_back({row["frame_ms"]["p50"].get<double>(),
                                                  measure.at_zero + measure.scale * value.get<double>(),
                                                  error, name + ", " + row["says"].get<std::string>()});
  }
  return chart;
}

/// Whether any point is above zero, by more than rounding.
bool shows_something(const ScatterChart& chart) {
  for (const ScatterSeries& series : chart.series) {
    for (const ScatterSeries::Point& point : series.points) {
      if (point.y > 1e-9) return true;
    }
  }
  return false;
}

std::string charts(const json& rows) {
  std::string none;
  std::string html =
      "<h2>What each error costs in time</h2>\n<p>Each point is a setting, labelled with its pixel error "
      "where there "
      "is room; left is faster, lower is truer, and no other setting beats those that are filled. Point at "
      "one to "
      "read what it buys.</p>\n";
  for (const Measure& measure : measures) {
    const ScatterChart chart = chart_of(rows, measure);
    if (!shows_something(chart)) {
      none += fmt::format("<li>{}: {}</li>\n", measure.name,
                          chart.series.empty() ? "not measured" : "0 at every setting");
      continue;
    }
    html += fmt::format("<figure class=\"chart\">{}<figcaption>{}</figcaption></figure>\n",
                        scatter_svg(chart), escape_html(measure.meaning));
  }
  return html + (none.empty() ? "" : "<ul>\n" + none + "</ul>\n");
}

std::string sentences(const json& rows) {
  std::string html = "<h2>What each setting buys</h2>\n";
  std::string last;
  for (const json& row : rows) {
    const std::string name = series_name(row, rows);
    if (name != last)
      html += (last.empty() ? "" : "</ul>\n") + fmt::format("<p>{}</p>\n<ul>\n", escape_html(name));
    last = name;
    html += fmt::format("<li>{}</li>\n", escape_html(row["says"].get<std::string>()));
  }
  html += "</ul>\n";
  for (const json& row : rows) {
    if (!row.contains("may_miss")) continue;
    html += fmt::format("<p class=\"quiet\">{}: {}</p>\n", escape_html(series_name(row, rows)),
                        escape_html(row["may_miss"].get<std::string>()));
    break;
  }
  return html;
}

/// What the packs promise beside distances.
std::string promises(const json& sentences) {
  std::string html;
  for (const json& sentence : sentences)
    html += fmt::format("<li>{}</li>\n", escape_html(sentence.get<std::string>()));
  return html.empty() ? html : "<p>Promises of the builds:</p>\n<ul>\n" + html + "</ul>\n";
}

std::string cell(const json& row, const char* pointer, double scale, int decimals) {
  const json value = figure(row, pointer);
  return value.is_number() ? grouped(scale * value.get<double>(), decimals) : "–";
}

/// What the columns are, and over what.
constexpr const char* legend =
    "px: the pixel error. ms, p95: median and 95th percentile of the frame times. triangles: drawn, the "
    "mean. "
    "build s, pack MB: what building the pack took where it was built for this, and its size in millions of "
    "bytes. "
    "wrong %: pixels that differ from full detail. deviation max, p99: how far surfaces are off on the "
    "screen, in "
    "pixels, the farthest of the points measured and 99 % of them. holes, swaps /M: pixels of holes and "
    "swaps a "
    "million pixels of surface. cover %: what things of at most 8 pixels keep of the pixels they cover; – "
    "where "
    "that is not measured or of fewer than 100 pixels. left out %: triangles in view that were not drawn. "
    "popping: "
    "change between successive frames beyond the reference's own, of 255, the mean over pixels. RMSE, SSIM, "
    "butteraugli: distances of pictures.";

std::string table(const json& report) {
  const json& rows = report["rows"];
  HtmlTable table{{"setting", "px", "ms", "p95", "triangles", "build s", "pack MB", "wrong %",
                   "deviation max", "p99", "holes /M", "swaps /M", "cover %", "left out %", "popping",
                   "shade p99", "RMSE", "SSIM", "butteraugli"},
                  {}};
  for (const json& row : rows) {
    table.rows.push_back({escape_html(series_name(row, rows)), cell(row, "/pixel_error", 1, 2),
                          cell(row, "/frame_ms/p50", 1, 2), cell(row, "/frame_ms/p95", 1, 2),
                          cell(row, "/drawn_triangles/mean", 1, 0), cell(row, "/build_seconds", 1, 1),
                          cell(row, "/pack_bytes", 1e-6, 1), cell(row, "/wrong_pixel_share", 100, 2),
                          cell(row, "/deviation_px/max", 1, 3), cell(row, "/deviation_px/p99", 1, 3),
                          cell(row, "/hole_share", 1e6, 0), cell(row, "/swap_share", 1e6, 0),
                          cell(row, "/cover_kept", 100, 1), cell(row, "/missed_triangle_share", 100, 1),
                          cell(row, "/popping", 1, 3), cell(row, "/shade/p99", 1, 0),
                          cell(row, "/rmse", 1, 2), cell(row, "/ssim", 1, 4),
                          cell(row, "/butteraugli", 1, 2)});
  }
  return fmt::format("<h2>All figures</h2>\n<p class=\"quiet\">{}</p>\n", legend) + to_html(table);
}

/// Which error to take, for each pack.
std::string advice(const json& report) {
  std::string html;
  for (const json& pack : report["advice"])
    html += fmt::format("<p>{}</p>\n", escape_html(pack["says"].get<std::string>()));
  return html;
}

std::string verdict(const json& report) {
  if (report["violations"] == 0)
    return "<p><span class=\"met\">Kept:</span> no surface was found farther off than its pixel error "
           "allows, holes and swaps are as promised below, and exact strategies drew the whole cut's "
           "pictures.</p>\n";
  std::string html = "<p><span class=\"missed\">Broken promises:</span></p>\n<ul>\n";
  for (const json& violation : report["violated"]) {
    const json& row = report["rows"][violation["row"].get<size_t>()];
    html +=
        fmt::format("<li>{}: frame {}, {}</li>\n", escape_html(series_name(row, report["rows"])),
                    violation["frame"].get<uint32_t>(), escape_html(violation["what"].get<std::string>()));
  }
  return html + "</ul>\n";
}

}  // namespace

std::string accuracy_page(const json& report) {
  const std::string title = report["title"].get<std::string>();
  std::string body = fmt::format("<h1>{}</h1>\n", escape_html(title)) +
                     fmt::format("<p class=\"quiet\">Path: {}.</p>\n",
                                 escape_html(report["frames_say"].get<std::string>())) +
                     verdict(report) + advice(report) + promises(report["promises"]);
  body += accuracy_strip(report) + charts(report["rows"]) + table(report) + sentences(report["rows"]) +
          accuracy_places(report);
  body += fmt::format("<p class=\"from\"><code>{}</code></p>\n",
                      escape_html(report["command"].get<std::string>()));
  return html_page(title, body);
}

}  // namespace triptych
