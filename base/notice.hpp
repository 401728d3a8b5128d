// Lines on standard error that tell what goes on.
#pragma once

#include "base/one_line.hpp"

#include <cstdio>
#include <fmt/core.h>
#include <string>

namespace triptych {

/// Prints the text at once; whether anybody still reads it, or there is room for it, does not matter.
inline void say(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

/// The same of one line, whatever stands in the arguments.
template <typename... Arguments>
void notice(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  say(one_line(fmt::format(format, std::forward<Arguments>(arguments)...)) + "\n");
}

}  // namespace triptych
