#include "measure/accuracy/accuracy_words.hpp"

#include "measure/accuracy/accuracy.hpp"

#include <algorithm>
#include <array>
#include <fmt/core.h>

namespace triptych {

using nlohmann::json;

namespace {

/// How many there are, and what was promised of them.
std::string patches_in_words(const json& row, const std::string& key, const char* name) {
  const json promised = row.value("promised", json::object()).value(name, json::object());
  const bool is_promised = promised.contains("limit_a_million") && !promised["limit_a_million"].is_null();
  const auto count = row[key + "_pixels"].get<uint64_t>();
  if (count == 0) return fmt::format(", 0 {}{}", name, is_promised ? " as promised" : "");
  const char* const says = !is_promised                     ? ""
                           : promised["broken"].get<bool>() ? ", WHICH BREAKS THE PROMISE"
                                                            : ", within the promise";
  return fmt::format(", {} pixel{} of {} (the largest patch has {}){}", count, count == 1 ? "" : "s", name,
                     row[key + "_largest"].get<uint64_t>(), says);
}

/// "1st", "2nd", "11th".
std::string ordinal(uint32_t number) {
  const uint32_t last = number % 10, teens = number % 100 / 10;
  const char* const ending = teens == 1  ? "th"
                             : last == 1 ? "st"
                             : last == 2 ? "nd"
                             : last == 3 ? "rd"
                                         : "th";
  return fmt::format("{}{}", number, ending);
}

}  // namespace

std::string speed_in_words(double faster) {
  constexpr double tenth = 0.1;
  if (faster >= 1 - tenth && faster <= 1 + tenth) return "about as fast as";
  return faster > 1 ? fmt::format("{:.1f} times faster than", faster)
                    : fmt::format("{:.1f} times slower than", 1 / faster);
}

std::string frames_in_words(size_t frames, size_t path_frames, uint32_t every) {
  if (frames == path_frames) return frames == 1 ? "its only frame" : fmt::format("all {} frames", frames);
  if (frames == 1) return fmt::format("frame 0 of {}", path_frames);
  return fmt::format("frames 0 to {} of {}, {}", (frames - 1) * every, path_frames,
                     every > 1 ? fmt::format("every {}", ordinal(every)) : "the beginning of the path");
}

std::string picture_in_words(const json& row) {
  std::string words = row["size"].get<std::string>();
  if (const auto samples = row["samples"].get<uint32_t>(); samples > 1)
    words += fmt::format(" and {} samples", samples);
  return words;
}

bool same_but_error(const json& one, const json& other) {
  constexpr std::array keys = {"pack",   "strategy", "min_pixels", "representation",
                               "device", "size",     "samples"};
  return std::all_of(keys.begin(), keys.end(), [&](const char* key) { return one[key] == other[key]; });
}

bool says_cover(const json& row) {
  return row["cover_kept"].is_number() && row["cover_pixels"].get<double>() >= least_cover_pixels;
}

std::string share_in_words(double share) {
  const double percent = 100 * share;
  if (percent == 0) return "none";
  if (percent < 0.01) return "less than 0.01 %";
  return fmt::format("{:.{}f} %", percent, percent < 0.1 ? 2 : percent < 10 ? 1 : 0);
}

std::string accuracy_sentence(const json& row, const json& rows) {
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
    text += fmt::format("{} {:g} px", speed_in_words(milliseconds(*base) / std::max(milliseconds(row), 1e-9)),
                        base_error);
  }
  const double worst = row["deviation_px"]["max"].get<double>();
  text += fmt::format(", {} of the pixels differ", share_in_words(row["wrong_pixel_share"].get<double>()));
  const auto compared = row["compared_frames"].get<size_t>();
  const std::string where = fmt::format("in {} compared frame{}", compared, compared == 1 ? "" : "s");
  if (worst < 0.005) {
    text += fmt::format(", every surface was found where it should be {}", where);
  } else {
    text += worst > tolerated_deviation(error)
                ? fmt::format(", SOME BY {:.3g} px, WHICH BREAKS THE PROMISE", worst)
                : fmt::format(", no surface was found off by more than {:.2g} px {}", worst, where);
  }
  text += patches_in_words(row, "hole", "holes") + patches_in_words(row, "swap", "swaps");
  if (says_cover(row))
    text += fmt::format(", small things keep {:.0f} % of their cover", 100 * row["cover_kept"].get<double>());
  if (const double missed = row["missed_triangle_share"].get<double>(); missed > 0)
    text += fmt::format(", {} of the triangles in view are left out", share_in_words(missed));
  return text;
}

std::vector<std::string> promises_in_words(const json& rows) {
  std::vector<std::string> sentences;
  for (const json& row : rows) {
    std::string name = row["pack"].get<std::string>();
    if (row.contains("may_miss")) name += ", " + row["strategy"].get<std::string>();
    const json promised = row.value("promised", json::object());
    for (const auto& [what, promise] : promised.items()) {
      std::string sentence = name + ": " + promise["says"].get<std::string>();
      if (std::count(sentences.begin(), sentences.end(), sentence) == 0)
        sentences.push_back(std::move(sentence));
    }
  }
  return sentences;
}

}  // namespace triptych
