#include "measure/accuracy/accuracy_advice.hpp"

#include "measure/accuracy/accuracy.hpp"
#include "measure/accuracy/accuracy_words.hpp"

#include <algorithm>
#include <fmt/core.h>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace triptych {

using nlohmann::json;

namespace {

/// One strategy of a pack at one error, on all devices and at all sizes.
struct Candidate {
  bool good = true, approximate = false;
  double ms = 0;                  ///< the sum of median frame times
  double swaps_a_million = 0;     ///< away from edges
  std::optional<double> cover{};  ///< the least
};

/// A strategy and what it was asked for, and its candidates by error.
struct Choice {
  json strategy, min_pixels;
  std::map<double, Candidate> by_error{};
};

void add(Candidate& candidate, const json& row) {
  const double swaps = 1e6 * row["swap_inner_share"].get<double>();
  candidate.ms += row["frame_ms"]["p50"].get<double>();
  candidate.approximate = !row["min_pixels"].is_null();
  candidate.swaps_a_million = std::max(candidate.swaps_a_million, swaps);
  if (says_cover(row)) {
    const double cover = row["cover_kept"].get<double>();
    candidate.cover = std::min(candidate.cover.value_or(cover), cover);
  }
  candidate.good =
      candidate.good && row["hole_pixels"] == 0 && swaps < most_swaps_a_million &&
      row["deviation_px"]["max"].get<double>() <= tolerated_deviation(row["pixel_error"].get<double>()) &&
      candidate.cover.value_or(1) >= least_cover_kept;
}

std::vector<Choice> choices_of(const json& rows, const json& violated, const json& pack) {
  std::vector<Choice> choices;
  for (size_t i = 0; i < rows.size(); ++i) {
    const json& row = rows[i];
    if (row["pack"] != pack) continue;
    auto found = std::find_if(choices.begin(), choices.end(), [&](const Choice& choice) {
      return choice.strategy == row["strategy"] && choice.min_pixels == row["min_pixels"];
    });
    if (found == choices.end()) found = choices.insert(choices.end(), {row["strategy"], row["min_pixels"]});
    Candidate& candidate = found->by_error[row["pixel_error"].get<double>()];
    add(candidate, row);
    for (const json& violation : violated) candidate.good = candidate.good && violation["row"] != i;
  }
  return choices;
}

struct Advised {
  const Choice* choice = nullptr;
  double pixel_error = 0;
  const Candidate* candidate = nullptr;
};

std::optional<Advised> best_of(const std::vector<Choice>& choices) {
  const auto cost = [](const Candidate& candidate) {
    return candidate.ms * (candidate.approximate ? approximate_gain : 1);
  };
  std::optional<Advised> best;
  for (const Choice& choice : choices) {
    for (const auto& [error, candidate] : choice.by_error) {
      if (!candidate.good) continue;
      if (!best || error > best->pixel_error ||
          (error == best->pixel_error && cost(candidate) < cost(*best->candidate)))
        best = Advised{&choice, error, &candidate};
    }
  }
  return best;
}

json advice_for(const json& pack, const std::vector<Choice>& choices) {
  const std::string name = pack.get<std::string>();
  json advice = {{"pack", pack},
                 {"strategy", nullptr},
                 {"min_pixels", nullptr},
                 {"pixel_error", nullptr},
                 {"faster", nullptr}};
  const std::optional<Advised> best = best_of(choices);
  if (!best) {
    advice["says"] = fmt::format(
        "{}: none of the errors measured is without holes, below {:g} swaps a million away from "
        "edges and keeps {:g} % of the cover of small things: measure finer ones",
        name, most_swaps_a_million, 100 * least_cover_kept);
    return advice;
  }
  const auto& [finest_error, finest] = *best->choice->by_error.begin();
  const double faster = finest.ms / std::max(best->candidate->ms, 1e-9);
  advice["strategy"] = best->choice->strategy;
  advice["min_pixels"] = best->choice->min_pixels;
  advice["pixel_error"] = best->pixel_error;
  advice["faster"] = faster;
  std::string strategy = best->choice->strategy.get<std::string>();
  if (!best->choice->min_pixels.is_null())
    strategy += fmt::format(" {}", best->choice->min_pixels.get<uint32_t>());
  std::string says = fmt::format("{}: take {:g} px ({}): no holes, {:.0f} swaps a million away from edges",
                                 name, best->pixel_error, strategy, best->candidate->swaps_a_million);
  if (best->candidate->cover)
    says += fmt::format(", small things keep {:.0f} % of their cover", 100 * *best->candidate->cover);
  says += finest_error < best->pixel_error
              ? fmt::format("; {} {:g} px, the finest measured", speed_in_words(faster), finest_error)
              : "; it is the finest measured";
  advice["says"] = says;
  return advice;
}

}  // namespace

json accuracy_advice(const json& rows, const json& violated) {
  json advice = json::array();
  std::vector<json> seen;
  for (const json& row : rows) {
    if (std::count(seen.begin(), seen.end(), row["pack"]) > 0) continue;
    seen.push_back(row["pack"]);
    advice.push_back(advice_for(row["pack"], choices_of(rows, violated, row["pack"])));
  }
  return advice;
}

}  // namespace triptych
