#include "launch/print_accuracy.hpp"

#include "launch/text_table.hpp"
#include "measure/accuracy/accuracy_words.hpp"
#include "measure/accuracy/butteraugli.hpp"
#include "measure/json.hpp"
#include "scene/skeleton.hpp"

#include <fmt/core.h>
#include <string>

namespace triptych {

namespace {

/// What each build costs and gives, where there are several packs: a line for each at each error, by the
/// first strategy, device, size and number of samples.
void print_packs(const nlohmann::json& rows) {
  const auto same = [&](const nlohmann::json& row) {
    for (const char* key : {"strategy", "min_pixels", "device", "size", "samples"})
      if (row[key] != rows[0][key]) return false;
    return true;
  };
  const auto number = [](const nlohmann::json& value, double scale, int decimals) {
    return value.is_number() ? in_threes(scale * value.get<double>(), decimals) : std::string("-");
  };
  std::vector<std::vector<std::string>> lines;
  bool several = false;
  for (const nlohmann::json& row : rows) {
    several = several || row["pack"] != rows[0]["pack"];
    if (!same(row)) continue;
    lines.push_back({row["pack"].get<std::string>(), number(row["pixel_error"], 1, 2),
                     number(row["drawn_triangles"]["mean"], 1, 0), number(row["build_seconds"], 1, 1),
                     number(row["pack_bytes"], 1, 0), number(row["frame_ms"]["p50"], 1, 1),
                     number(row["hole_share"], 1e6, 0), number(row["swap_share"], 1e6, 0),
                     says_cover(row) ? number(row["cover_kept"], 100, 0) : "-"});
  }
  if (!several) return;
  fmt::print("\n{}\n", text_table({"pack", "px", "triangles", "build s", "bytes", "ms", "holes/M", "swaps/M",
                                   "cover %"},
                                  lines));
}

}  // namespace

void print_accuracy(const nlohmann::json& report, bool perceptual) {
  for (const nlohmann::json& row : report["rows"]) {
    std::string name = row["strategy"].get<std::string>();
    if (!row["min_pixels"].is_null()) name += fmt::format(" {}", row["min_pixels"].get<uint32_t>());
    fmt::print("{} on {}, {}, {}: {}\n", name, row["device"].get<std::string>(), picture_in_words(row),
               row["pack"].get<std::string>(), row["says"].get<std::string>());
  }
  for (const nlohmann::json& promise : report["promises"]) fmt::print("{}\n", promise.get<std::string>());
  print_packs(report["rows"]);
  for (const nlohmann::json& advice : report["advice"]) fmt::print("{}\n", advice["says"].get<std::string>());
  fmt::print("{}: {} timed in turn, {} compared; times are medians\n",
             report["frames_say"].get<std::string>(), report["frames"].get<size_t>(),
             report["rows"][0]["compared_frames"].get<size_t>());
  if (!perceptual) fmt::print("butteraugli was not measured: install the package {}\n", Butteraugli::package);
  for (const nlohmann::json& violation : report["violated"]) {
    const nlohmann::json& row = report["rows"][violation["row"].get<size_t>()];
    fmt::print(stderr, "{}, {} on {}, {} at {:g} px, frame {}: {}", row["pack"].get<std::string>(),
               row["strategy"].get<std::string>(), row["device"].get<std::string>(), picture_in_words(row),
               row["pixel_error"].get<double>(), violation["frame"].get<uint32_t>(),
               violation["what"].get<std::string>());
    if (violation.contains("drawable"))
      fmt::print(stderr, ", of drawable {} at {}", violation["drawable"].get<DrawableId>(),
                 json_text(violation["place"]));
    fmt::print(stderr, "\n");
  }
}

}  // namespace triptych
