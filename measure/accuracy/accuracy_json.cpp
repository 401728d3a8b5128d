#include "measure/accuracy/accuracy_json.hpp"

#include "measure/json.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <limits>
#include <optional>
#include <set>

namespace triptych {

using nlohmann::json;

namespace {

json or_null(const std::optional<double>& value) { return value ? json(*value) : json(); }

template <typename Value>
json frames_json(const AccuracyRow& row, Value value) {
  return distribution_json(row.frames, value);
}

/// A deviation may be infinite, which JSON has no number for.
double finite(double value) { return std::min(value, std::numeric_limits<double>::max()); }

json deviation_json(const PictureTally& pictures) {
  std::vector<float> sorted = pictures.deviations;
  std::sort(sorted.begin(), sorted.end());
  const auto rank = [&](double share) {
    if (sorted.empty()) return 0.0;
    const auto place = static_cast<size_t>(std::ceil(share * static_cast<double>(sorted.size())));
    return finite(double{sorted[std::clamp<size_t>(place, 1, sorted.size()) - 1]});
  };
  return {{"median", rank(0.5)}, {"p99", rank(0.99)}, {"max", finite(pictures.worst_deviation.point.pixels)}};
}

json row_json(const AccuracyRow& row) {
  using Frame = AccuracyRow::Frame;
  const PictureTally& pictures = *row.pictures;
  json object = {{"pack", row.pack},
                 {"strategy", row.strategy},
                 {"representation", row.representation},
                 {"device", row.device},
                 {"size", fmt::format("{}x{}", row.width, row.height)},
                 {"pixel_error", row.pixel_error},
                 {"min_pixels", row.min_pixels > 0 ? json(row.min_pixels) : json()}};
  object["frame_ms"] = frames_json(row, [](const Frame& f) { return f.frame_ms; });
  object["cpu_ms"] = frames_json(row, [](const Frame& f) { return f.cpu_ms; });
  object["stages_ms"] = {
      {"occlusion_representation",
       frames_json(row, [](const Frame& f) { return f.occlusion_representation_ms; })},
      {"hardware_cull", frames_json(row, [](const Frame& f) { return f.hardware_cull_ms; })},
      {"render", frames_json(row, [](const Frame& f) { return f.render_ms; })}};
  object["drawn_triangles"] = frames_json(row, [](const Frame& f) { return f.drawn_triangles; });
  object["drawables"] = frames_json(row, [](const Frame& f) { return f.drawables; });
  object["compared_frames"] = pictures.frames();
  object["wrong_pixel_share"] = pictures.share_of_pixels(pictures.wrong_pixels);
  object["deviation_px"] = deviation_json(pictures);
  object["hole_share"] = pictures.share_of_surface(pictures.hole_pixels);
  object["hole_pixels"] = pictures.hole_pixels;
  object["hole_largest"] = pictures.hole.pixels;
  object["swap_share"] = pictures.share_of_surface(pictures.swap_pixels);
  object["swap_pixels"] = pictures.swap_pixels;
  object["swap_largest"] = pictures.swap.pixels;
  object["cover_pixels"] = pictures.cover_pixels();
  object["cover_kept"] = or_null(pictures.cover_kept());
  object["cover_grown"] = or_null(pictures.cover_grown());
  object["popping"] = or_null(pictures.popping());
  object["flicker_share"] = or_null(pictures.flicker_share());
  object["rmse"] = pictures.rmse();
  object["ssim"] = pictures.ssim();
  object["butteraugli"] = or_null(pictures.butteraugli());
  object["untraced_share"] = pictures.share_of_surface(pictures.untraced_pixels);
  object["missed_triangle_share"] = row.owning_triangles > 0 ? static_cast<double>(row.missed_triangles) /
                                                                   static_cast<double>(row.owning_triangles)
                                                             : 0.0;
  if (!row.may_miss.empty()) object["may_miss"] = row.may_miss;
  return object;
}

/// What a setting is.
constexpr std::array setting_keys = {"pack",   "strategy", "min_pixels", "representation",
                                     "device", "size",     "pixel_error"};

/// Whether two rows differ in the pixel error alone.
bool same_but_error(const json& one, const json& other) {
  return std::all_of(setting_keys.begin(), setting_keys.end() - 1,
                     [&](const char* key) { return one[key] == other[key]; });
}

/// "3", "0.4" or "0.05": as many digits as matter.
std::string share_in_words(double share) {
  const double percent = 100 * share;
  if (percent == 0) return "none";
  if (percent < 0.01) return "less than 0.01 %";
  return fmt::format("{:.{}f} %", percent, percent < 0.1 ? 2 : percent < 10 ? 1 : 0);
}

std::string sentence(const json& row, const json& rows) {
  const double error = row["pixel_error"].get<double>();
  // Held against the same setting at 1 px or, where that is not there, at the smallest error.
  const json* base = nullptr;
  for (const json& other : rows) {
    if (!same_but_error(row, other)) continue;
    const double candidate = other["pixel_error"].get<double>();
    if (base == nullptr || candidate == 1 ||
        ((*base)["pixel_error"] != 1 && candidate < (*base)["pixel_error"].get<double>()))
      base = &other;
  }
  const auto milliseconds = [](const json& of) { return of["frame_ms"]["p50"].get<double>(); };
  std::string text = fmt::format("{:g} px: ", error);
  const double base_error = (*base)["pixel_error"].get<double>();
  if (base_error == error) {
    text += fmt::format("{:.1f} ms a frame", milliseconds(row));
  } else {
    const double faster = milliseconds(*base) / std::max(milliseconds(row), 1e-9);
    text += faster >= 1 ? fmt::format("{:.1f} times faster than {:g} px", faster, base_error)
                        : fmt::format("{:.1f} times slower than {:g} px", 1 / faster, base_error);
  }
  const double worst = row["deviation_px"]["max"].get<double>();
  text += fmt::format(", {} of the pixels differ", share_in_words(row["wrong_pixel_share"].get<double>()));
  if (worst < 0.005) {
    text += ", every surface is where it should be";
  } else {
    text += worst > tolerated_deviation(error)
                ? fmt::format(", SOME BY {:.3g} px, WHICH BREAKS THE PROMISE", worst)
                : fmt::format(", no surface is off by more than {:.2g} px", worst);
  }
  const auto counted = [&](const char* pixels, const char* largest, const char* name) {
    const auto count = row[pixels].get<uint64_t>();
    if (count == 0) return fmt::format(", 0 {}", name);
    return fmt::format(", {} pixel{} of {} (the largest patch has {})", count, count == 1 ? "" : "s", name,
                       row[largest].get<uint64_t>());
  };
  text += counted("hole_pixels", "hole_largest", "holes") + counted("swap_pixels", "swap_largest", "swaps");
  if (row["cover_pixels"].get<double>() > 0)
    text += fmt::format(", small things keep {:.0f} % of their cover", 100 * row["cover_kept"].get<double>());
  if (const double missed = row["missed_triangle_share"].get<double>(); missed > 0)
    text += fmt::format(", {} of the triangles in view are left out", share_in_words(missed));
  return text;
}

void append_csv(const std::string& name, const json& value, std::vector<std::string>& names,
                std::vector<std::string>& cells) {
  if (value.is_object()) {
    for (const auto& [key, inner] : value.items()) append_csv(name + "." + key, inner, names, cells);
    return;
  }
  names.push_back(name);
  std::string text = value.is_null() ? "" : value.is_string() ? value.get<std::string>() : json_text(value);
  if (text.find_first_of(",\"\n") != std::string::npos) {
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    text = quoted + "\"";
  }
  cells.push_back(text);
}

std::string joined(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& cell : cells) line += (line.empty() && &cell == &cells.front() ? "" : ",") + cell;
  return line + "\n";
}

}  // namespace

json accuracy_json(const AccuracyResult& result) {
  json rows = json::array(), violated = json::array();
  for (const AccuracyRow& row : result.rows) rows.push_back(row_json(row));
  for (json& row : rows) row["says"] = sentence(row, rows);
  for (const AccuracyViolation& violation : result.violations) {
    json object = {{"row", violation.row}, {"what", violation.what}, {"frame", violation.frame}};
    if (violation.point.drawable != no_id) {
      object["drawable"] = violation.point.drawable;
      object["place"] = {violation.point.place.x, violation.point.place.y, violation.point.place.z};
      object["pixels"] = finite(violation.point.pixels);
    }
    violated.push_back(object);
  }
  return {{"rows", rows}, {"violations", violated.size()}, {"violated", violated}};
}

std::string accuracy_csv(const json& report) {
  std::string text;
  for (const json& row : report["rows"]) {
    std::vector<std::string> names, cells;
    const std::set<std::string> first(setting_keys.begin(), setting_keys.end());
    for (const char* key : setting_keys) append_csv(key, row[key], names, cells);
    for (const auto& [key, value] : row.items()) {
      if (key != "may_miss" && first.count(key) == 0) append_csv(key, value, names, cells);
    }
    if (text.empty()) text = joined(names);
    text += joined(cells);
  }
  return text;
}

}  // namespace triptych
