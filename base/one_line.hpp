// Foreign text in one line.
#pragma once

#include <algorithm>
#include <string>

namespace triptych {

/// The text with blanks for line breaks and other control characters, which file names and files may contain.
inline std::string one_line(std::string text) {
  constexpr char last_control = 0x1f, del = 0x7f;
  std::replace_if(
      text.begin(), text.end(),
      [](const char letter) { return (letter >= 0 && letter <= last_control) || letter == del; }, ' ');
  return text;
}

}  // namespace triptych
