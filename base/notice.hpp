// Lines on standard error about what the program is doing.
#pragma once

#include "base/one_line.hpp"

#include <cstdio>
#include <fmt/core.h>
#include <string>

namespace triptych {

/// Prints the text at once; ignores errors, such as a closed pipe or a full disk.
inline void say(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

/// Prints one line, whatever the arguments contain.
template <typename... Arguments>
void notice(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  say(one_line(fmt::format(format, std::forward<Arguments>(arguments)...)) + "\n");
}

/// The same where the line was not printed before: for what strangers can cause again and again. After a
/// hundred different lines it is silent.
void notice_once(const std::string& line);

}  // namespace triptych
