// Flags whose value is a time, a rate or a size.
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>

namespace triptych {

/// Admits finite numbers above 0; CLI11's own PositiveNumber admits NaN.
inline CLI::Validator positive_number() {
  return CLI::Validator(
      [](std::string& text) {
        double value = 0;
        const bool number = CLI::detail::lexical_cast(text, value);
        return number && value > 0 && std::isfinite(value) ? std::string()
                                                           : "\"" + text + "\" is no number above 0";
      },
      "NUMBER>0");
}

}  // namespace triptych
