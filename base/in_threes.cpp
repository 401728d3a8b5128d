#include "base/in_threes.hpp"

#include <algorithm>
#include <fmt/core.h>

namespace triptych {

std::string in_threes(double value, int decimals, std::string_view mark) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  const size_t start = text.front() == '-' ? 1 : 0;
  for (size_t i = std::min(text.find('.'), text.size()); i > start + 3; i -= 3) text.insert(i - 3, mark);
  return text;
}

}  // namespace triptych
