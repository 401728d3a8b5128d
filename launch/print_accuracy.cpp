#include "launch/print_accuracy.hpp"

#include "measure/accuracy/butteraugli.hpp"
#include "measure/json.hpp"
#include "scene/skeleton.hpp"

#include <fmt/core.h>
#include <string>

namespace triptych {

void print_accuracy(const nlohmann::json& report, bool perceptual) {
  for (const nlohmann::json& row : report["rows"]) {
    std::string name = row["strategy"].get<std::string>();
    if (!row["min_pixels"].is_null()) name += fmt::format(" {}", row["min_pixels"].get<uint32_t>());
    fmt::print("{} on {}, {}, {}: {}\n", name, row["device"].get<std::string>(),
               row["size"].get<std::string>(), row["pack"].get<std::string>(),
               row["says"].get<std::string>());
  }
  for (const nlohmann::json& advice : report["advice"]) fmt::print("{}\n", advice["says"].get<std::string>());
  fmt::print("{}: {} timed in turn, {} compared; times are medians\n",
             report["frames_say"].get<std::string>(), report["frames"].get<size_t>(),
             report["rows"][0]["compared_frames"].get<size_t>());
  if (!perceptual) fmt::print("butteraugli was not measured: install the package {}\n", Butteraugli::package);
  for (const nlohmann::json& violation : report["violated"]) {
    const nlohmann::json& row = report["rows"][violation["row"].get<size_t>()];
    fmt::print(stderr, "{} at {:g} px, frame {}: {}", row["strategy"].get<std::string>(),
               row["pixel_error"].get<double>(), violation["frame"].get<uint32_t>(),
               violation["what"].get<std::string>());
    if (violation.contains("drawable"))
      fmt::print(stderr, ", of drawable {} at {}", violation["drawable"].get<DrawableId>(),
                 json_text(violation["place"]));
    fmt::print(stderr, "\n");
  }
}

}  // namespace triptych
