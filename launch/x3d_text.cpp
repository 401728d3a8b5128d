#include "launch/x3d_text.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace triptych {

namespace {

constexpr std::array<std::string_view, 3> quotes = {"\"", "&quot;", "&#34;"};

/// The length of a quote that the text begins with; 0: it begins with something else.
size_t quote_at(std::string_view text) {
  for (const std::string_view quote : quotes) {
    if (text.starts_with(quote)) return quote.size();
  }
  return 0;
}

/// The value of an attribute, which is a list of strings if it begins with a quote.
void append_value(std::string_view value, std::string& result) {
  const size_t begin = std::min(value.find_first_not_of(" \t\r\n"), value.size());
  if (quote_at(value.substr(begin)) == 0) {
    result += value;
    return;
  }
  while (!value.empty()) {
    const size_t quote = quote_at(value);
    if (quote == 0) result += value.front();
    value.remove_prefix(std::max<size_t>(quote, 1));
  }
}

}  // namespace

std::string without_quotes_in_lists(const std::string& x3d) {
  std::string result;
  result.reserve(x3d.size());
  const std::string_view text = x3d;
  for (size_t at = 0; at < text.size();) {
    const bool opens = text[at] == '\'' || text[at] == '"';
    const size_t before = opens && at > 0 ? text.find_last_not_of(" \t\r\n", at - 1) : std::string_view::npos;
    result += text[at];
    ++at;
    if (before == std::string_view::npos || text[before] != '=') continue;
    const size_t end = text.find(text[at - 1], at);
    if (end == std::string_view::npos) continue;
    append_value(text.substr(at, end - at), result);
    result += text[end];
    at = end + 1;
  }
  return result;
}

}  // namespace triptych
