// Flags whose value is a number: what CLI11 itself would accept (NaN, -1 as the largest number, 010 as 8) is
// a usage error here, or means what people expect.
#pragma once

#include <CLI/CLI.hpp>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fmt/core.h>
#include <limits>
#include <optional>
#include <string>

namespace triptych {

/// Accepts finite numbers above 0.
inline CLI::Validator positive_number() {
  return CLI::Validator(
      [](std::string& text) {
        double value = 0;
        const bool number = CLI::detail::lexical_cast(text, value);
        return number && value > 0 && std::isfinite(value)
                   ? std::string()
                   : fmt::format("\"{}\" is not a number above 0", text);
      },
      "NUMBER>0");
}

/// Accepts numbers of a range.
inline CLI::Validator number_between(double least, double most) {
  return CLI::Validator(
      [=](std::string& text) {
        double value = 0;
        const bool number = CLI::detail::lexical_cast(text, value);
        return number && value >= least && value <= most
                   ? std::string()
                   : fmt::format("\"{}\" is not a number from {} to {}", text, least, most);
      },
      "NUMBER");
}

/// Accepts whole numbers in decimal digits, and removes leading zeros, which CLI11 would take for octal.
inline CLI::Validator whole_number(uint64_t least, uint64_t most = std::numeric_limits<uint64_t>::max()) {
  return CLI::Validator(
      [=](std::string& text) {
        uint64_t value = 0;
        const char* const end = text.data() + text.size();
        const auto read = std::from_chars(text.data(), end, value);
        const bool number = read.ec == std::errc() && read.ptr == end && (text.front() != '0' || value == 0);
        return number && value >= least && value <= most
                   ? std::string()
                   : fmt::format("\"{}\" is not a whole number from {} to {}", text, least, most);
      },
      "");
}

/// Accepts bytes as whole numbers, with suffixes K, M, G or T for powers of 1,024, and passes on the number.
inline CLI::Validator bytes_from(uint64_t least, const std::string& min_text) {
  return CLI::Validator(
      [=](std::string& text) {
        uint64_t value = 0;
        const char* const end = text.data() + text.size();
        const auto read = std::from_chars(text.data(), end, value);
        const std::string suffix(read.ptr, end), suffixes = "KMGT";
        const size_t power =
            suffix.size() == 1
                ? suffixes.find(static_cast<char>(std::toupper(static_cast<unsigned char>(suffix.front()))))
                : 0;
        const size_t shift = suffix.empty() ? 0 : 10 * (power + 1);
        const bool number = read.ec == std::errc() && suffix.size() <= 1 && power != std::string::npos &&
                            value <= std::numeric_limits<uint64_t>::max() >> shift;
        if (!number || value << shift < least)
          return fmt::format("\"{}\" is not a number of bytes from {} on, such as 512M or 2G", text,
                             min_text);
        text = std::to_string(value << shift);
        return std::string();
      },
      "");
}

/// --cache-limit: bytes; less than a megabyte holds nothing of use.
inline CLI::Option* add_cache_limit(CLI::App& command, std::optional<uint64_t>& limit,
                                    const std::string& description) {
  return command.add_option("--cache-limit", limit, description)
      ->transform(bytes_from(uint64_t{1} << 20, "1M"))
      ->type_name("BYTES");
}

/// Limits of times (one day) and of rates, beyond which a value is certainly a mistake.
constexpr double max_seconds = 86400, min_rate = 0.001, max_rate = 1e6;

/// Makes a flag for a vector take one word, and not the words after it.
inline CLI::Option* take_one(CLI::Option* option) { return option->expected(1)->allow_extra_args(false); }
/// The same, where the word may be a list of values separated by commas.
inline CLI::Option* take_list(CLI::Option* option) {
  return option->expected(1, CLI::detail::expected_max_vector_size)->delimiter(',')->allow_extra_args(false);
}

}  // namespace triptych
