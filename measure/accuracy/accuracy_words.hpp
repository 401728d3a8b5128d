// What measure_accuracy() found in words.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace triptych {

/// What is measured of small things is only said where it is about so many pixels.
inline constexpr double least_cover_pixels = 100;

/// Whether a row of accuracy_json() has it, about so many.
bool says_cover(const nlohmann::json& row);

/// "3 %", "0.4 %" or "0.05 %": as many digits as matter; "none" of 0.
std::string share_in_words(double share);

/// "1.4 times faster than", "1.4 times slower than", or "about as fast as" within a tenth.
std::string speed_in_words(double faster);

/// Which frames of a path were taken: "all 300 frames", "frames 0 to 280 of 300, every 20th", or "frames 0 to
/// 11 of 300, the beginning of the path".
std::string frames_in_words(size_t frames, size_t path_frames, uint32_t every);

/// A row's pictures: "512x512", "512x512 and 4 samples".
std::string picture_in_words(const nlohmann::json& row);

/// A row of accuracy_json() in one sentence, beside the rows of the same setting at other errors.
std::string accuracy_sentence(const nlohmann::json& row, const nlohmann::json& rows);

/// What the builds promise of holes and swaps, or why they do not: a sentence for each pack and strategy,
/// each once.
std::vector<std::string> promises_in_words(const nlohmann::json& rows);

/// Whether two rows differ in the pixel error alone.
bool same_but_error(const nlohmann::json& one, const nlohmann::json& other);

}  // namespace triptych
