#include "measure/accuracy/accuracy_json.hpp"

#include "measure/accuracy/accuracy_advice.hpp"
#include "measure/accuracy/accuracy_promises.hpp"
#include "measure/accuracy/accuracy_words.hpp"
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
                 {"samples", row.samples},
                 {"pixel_error", row.pixel_error},
                 {"min_pixels", row.min_pixels > 0 ? json(row.min_pixels) : json()}};
  object["build"] = row.build.empty() ? json() : json(row.build);
  object["build_seconds"] = or_null(row.build_seconds);
  object["pack_bytes"] = row.pack_bytes;
  for (const PatchPromise& promise : patch_promises()) {
    const bool promised = is_promised(promise, row);
    object["promised"][promise.what] = {
        {"limit_a_million", promised ? json(promise.limit) : json()},
        {"broken", promised && is_broken(promise, row)},
        {"says", promised
                     ? promise.keep() + " promises " + promise.in_words()
                     : std::string(promise.what) + " are not promised: " + why_not_promised(promise, row)}};
  }
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
  object["slit_pixels"] = pictures.slit_pixels;
  object["thin_pixels"] = pictures.thin_pixels;
  object["swap_share"] = pictures.share_of_surface(pictures.swap_pixels);
  object["swap_pixels"] = pictures.swap_pixels;
  object["swap_largest"] = pictures.swap.pixels;
  object["swap_inner_pixels"] = pictures.inner_swap_pixels;
  object["swap_inner_share"] = pictures.share_of_surface(pictures.inner_swap_pixels);
  object["cover_pixels"] = pictures.cover_pixels();
  object["cover_kept"] = or_null(pictures.cover_kept());
  object["cover_grown"] = or_null(pictures.cover_grown());
  object["popping"] = or_null(pictures.popping());
  object["flicker_share"] = or_null(pictures.flicker_share());
  const auto shades = [](const ShadeDifferences& of) { return json{{"mean", of.mean()}, {"p99", of.p99()}}; };
  object["shade"] = shades(pictures.shades);
  object["surface_shade"] = shades(pictures.surface_shades);
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
                                     "device", "size",     "samples",    "pixel_error"};

/// What is no figure, or not the same in all rows.
bool in_words(const std::string& key) { return key == "may_miss" || key == "build" || key == "promised"; }

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
  for (json& row : rows) row["says"] = accuracy_sentence(row, rows);
  for (const AccuracyViolation& violation : result.violations) {
    json object = {{"row", violation.row}, {"what", violation.what}, {"frame", violation.frame}};
    if (violation.point.drawable != no_id) {
      object["drawable"] = violation.point.drawable;
      object["place"] = {violation.point.place.x, violation.point.place.y, violation.point.place.z};
      object["pixels"] = finite(violation.point.pixels);
    }
    violated.push_back(object);
  }
  const json advice = accuracy_advice(rows, violated);
  return {{"rows", rows},
          {"promises", promises_in_words(rows)},
          {"violations", violated.size()},
          {"violated", violated},
          {"advice", advice}};
}

std::string accuracy_csv(const json& report) {
  std::string text;
  for (const json& row : report["rows"]) {
    std::vector<std::string> names, cells;
    const std::set<std::string> first(setting_keys.begin(), setting_keys.end());
    for (const char* key : setting_keys) append_csv(key, row[key], names, cells);
    for (const auto& [key, value] : row.items()) {
      if (!in_words(key) && first.count(key) == 0) append_csv(key, value, names, cells);
    }
    if (text.empty()) text = joined(names);
    text += joined(cells);
  }
  return text;
}

}  // namespace triptych
