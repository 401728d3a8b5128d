// Lines on standard error that tell what goes on.
#pragma once

#include <cstdio>
#include <fmt/core.h>
#include <string>

namespace triptych {

/// Prints one line at once; whether anybody still reads it does not matter.
template <typename... Arguments>
void notice(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  const std::string line = fmt::format(format, std::forward<Arguments>(arguments)...) + "\n";
  std::fwrite(line.data(), 1, line.size(), stderr);
  std::fflush(stderr);
}

}  // namespace triptych
