#include "launch/solid_report.hpp"

#include "base/error.hpp"
#include "launch/text_table.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace triptych {

nlohmann::json to_json(const SolidCounts& counts) {
  return {{"placements", counts.placements},
          {"solid_placements", counts.solid_placements},
          {"objects", counts.objects},
          {"solid_objects", counts.solid_objects}};
}

std::string in_words(const SolidCounts& counts) {
  const auto words = [](uint64_t count) { return in_threes(static_cast<double>(count)); };
  if (counts.solid_placements == 0)
    return fmt::format("none of {} placed parts is solid: sections show no cut surfaces",
                       words(counts.placements));
  const std::string of_objects =
      counts.objects == 0
          ? ""
          : fmt::format(", {} of {} objects as a whole", words(counts.solid_objects), words(counts.objects));
  return fmt::format("{} of {} placed parts are solid{}: sections show their cut surfaces",
                     words(counts.solid_placements), words(counts.placements), of_objects);
}

void list_solids(const Pack& pack, nlohmann::json& description) {
  description["solids"] = nullptr;
  try {
    const SolidCounts counts = count_solids(pack);
    description["solids"] = to_json(counts);
    fmt::print("{}\n", in_words(counts));
  } catch (const Error& error) {
    fmt::print("how many are solid is not known: {}\n", error.what());
  }
}

}  // namespace triptych
