#include "report/accuracy_pictures_html.hpp"

#include "report/accuracy_series.hpp"
#include "report/html.hpp"

#include <fmt/core.h>
#include <map>

namespace triptych {

using nlohmann::json;

namespace {

std::string image(const std::string& file, const std::string& caption) {
  return fmt::format(
      "<figure><img src=\"{}\" alt=\"{}\" loading=\"lazy\"><figcaption>{}</figcaption></figure>\n",
      escape_html(file), escape_html(caption), escape_html(caption));
}

/// "at 0.5 px of error (frustum, occlusion) and at 1 px of error (frustum)": the rows of a patch.
std::string settings_of(const json& patch, const json& rows) {
  std::map<double, std::string> names;
  for (const json& index : patch["rows"]) {
    const json& row = rows[index.get<size_t>()];
    std::string& list = names[row["pixel_error"].get<double>()];
    list += (list.empty() ? "" : "; ") + series_name(row, rows);
  }
  std::string text;
  for (const auto& [error, list] : names)
    text += fmt::format("{}at {:g} px of error ({})", text.empty() ? "" : ", ", error, list);
  return text;
}

}  // namespace

std::string accuracy_strip(const json& report) {
  std::string html = "<h2>One frame at each pixel error</h2>\n<div class=\"pictures\">\n";
  for (const json& item : report["strip"]) {
    const double error = item["pixel_error"].get<double>();
    html += image(item["file"].get<std::string>(),
                  error > 0 ? fmt::format("{:g} px", error)
                            : fmt::format("full detail, frame {}", item["frame"].get<uint32_t>()));
    if (item.contains("difference"))
      html += image(item["difference"].get<std::string>(),
                    fmt::format("{:g} px: the difference, four times", error));
  }
  return html + "</div>\n";
}

std::string accuracy_places(const json& report) {
  static const std::map<std::string, const char*> names = {
      {"hole", "The largest hole"}, {"swap", "The largest swap"}, {"deviation", "The largest deviation"}};
  std::string html = "<h2>The worst places</h2>\n";
  html += report["patches"].empty()
              ? "<p>There are none: no holes, no swaps, no deviation.</p>\n"
              : "<p>Each picture once, with the settings that show it; a frame marks the place.</p>\n";
  for (const json& patch : report["patches"]) {
    const json& row = report["rows"][patch["row"].get<size_t>()];
    const auto kind = patch["kind"].get<std::string>();
    const auto pixels = patch["pixels"].get<uint64_t>();
    std::string size = fmt::format("{} pixel{}", pixels, pixels == 1 ? "" : "s");
    if (kind == "deviation") size = fmt::format("{:.3g} px", row["deviation_px"]["max"].get<double>());
    html += fmt::format("<p>{} {}: {}, frame {}, around pixel {},{}</p>\n", names.at(kind),
                        escape_html(settings_of(patch, report["rows"])), size, patch["frame"].get<uint32_t>(),
                        patch["x"].get<int>(), patch["y"].get<int>());
    const auto enlarged = fmt::format("{} times enlarged", patch["enlarged"].get<int>());
    html += "<div class=\"pictures\">\n" +
            image(patch["reference"].get<std::string>(), "full detail, " + enlarged) +
            image(patch["shown"].get<std::string>(), "as drawn, " + enlarged) +
            image(patch["difference"].get<std::string>(), "four times the difference, " + enlarged) +
            "</div>\n";
  }
  return html;
}

}  // namespace triptych
