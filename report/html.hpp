// The HTML elements that reports are made of.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace triptych {

/// Text escaped for use between tags and inside quoted attributes.
std::string escape_html(std::string_view text);

/// "12 345" with narrow spaces that do not break, decimals after the point.
std::string grouped(double value, int decimals = 0);

/// A table whose first column names the row and whose other columns are figures. The cells are HTML.
struct HtmlTable {
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
};
std::string to_html(const HtmlTable& table);

/// How many colours series have: the classes series-1, series-2 and so on.
inline constexpr size_t series_colors = 8;

/// The whole page around a body: style for light and dark, wide and narrow windows; nothing is loaded from
/// elsewhere.
std::string html_page(const std::string& title, const std::string& body);

}  // namespace triptych
