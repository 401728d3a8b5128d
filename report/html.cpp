#include "report/html.hpp"

#include "base/in_threes.hpp"

#include <fmt/core.h>

namespace triptych {

std::string escape_html(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::string grouped(double value, int decimals) { return in_threes(value, decimals, "\u202f"); }

std::string to_html(const HtmlTable& table) {
  std::string html = "<div class=\"wide\"><table>\n<thead><tr>";
  for (const std::string& cell : table.head) html += "<th>" + cell + "</th>";
  html += "</tr></thead>\n<tbody>\n";
  for (const std::vector<std::string>& row : table.rows) {
    html += "<tr>";
    for (size_t i = 0; i < row.size(); ++i)
      html += i == 0 ? "<th>" + row[i] + "</th>" : "<td>" + row[i] + "</td>";
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

namespace {
constexpr const char* style = R"css(
:root { color-scheme: light dark; --page: #fcfcfb; --ink: #1b1d21; --quiet: #62666e; --rule: #dfe0e3; --panel: #f3f3f1;
  --one: #2563b8; --two: #c2560c; --three: #287d4d; --four: #8a3ea8; --five: #9a6b00; --six: #00798a; --seven: #b0346b; --eight: #5d6470; --bad: #b3261e; }
@media (prefers-color-scheme: dark) { :root { --page: #16181b; --ink: #e6e7e9; --quiet: #9ba0a8; --rule: #33363b;
  --panel: #1f2226; --one: #74a9f5; --two: #f0985a; --three: #6cc592; --four: #cf8ee8; --five: #d9b04a; --six: #57c3d3; --seven: #f089b4; --eight: #aab0ba; --bad: #ff8a80; } }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 62rem; padding: 2rem 1.2rem 4rem; background: var(--page); color: var(--ink);
  font: 16px/1.55 system-ui, "DejaVu Sans", sans-serif; }
h1 { font-size: 1.7rem; line-height: 1.2; margin: 0 0 .6rem; }
h2 { font-size: 1.15rem; margin: 2.6rem 0 .6rem; padding-top: .8rem; border-top: 1px solid var(--rule); }
p { max-width: 46rem; margin: .5rem 0; }
.wide { overflow-x: auto; margin: .6rem 0; }
table { border-collapse: collapse; width: 100%; font-size: .9rem; font-variant-numeric: tabular-nums; }
th, td { padding: .3rem .7rem; border-bottom: 1px solid var(--rule); text-align: right; vertical-align: top; }
th:first-child { text-align: left; padding-left: 0; }
th { font-weight: 500; } thead th { color: var(--quiet); font-weight: 400; vertical-align: bottom; }
.met { color: var(--three); font-weight: 600; }
.missed { color: var(--bad); font-weight: 600; }
.from, figcaption, .quiet { color: var(--quiet); font-size: .82rem; }
.from { max-width: none; } code { font: .95em ui-monospace, "DejaVu Sans Mono", monospace; overflow-wrap: anywhere; }
.from code { display: block; background: var(--panel); padding: .25rem .5rem; margin: .2rem 0; border-radius: 3px; }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(15rem, 44vw), 1fr)); gap: 1rem; }
figure { margin: 1rem 0; } .pictures figure { margin: 0; }
img { width: 100%; height: auto; display: block; background: var(--panel); border-radius: 3px; }
.chart { overflow-x: auto; } svg { width: 100%; min-width: 34rem; max-width: 50rem; height: auto; display: block; }
svg polyline, svg line { fill: none; stroke-width: 1.6; stroke-linejoin: round; }
svg .grid { stroke: var(--rule); stroke-width: 1; } svg .label { fill: var(--quiet); font-size: 12px; }
.end { text-anchor: end; } .middle { text-anchor: middle; }
.series-1 { --own: var(--one); } .series-2 { --own: var(--two); } .series-3 { --own: var(--three); }
.series-4 { --own: var(--four); } .series-5 { --own: var(--five); } .series-6 { --own: var(--six); }
.series-7 { --own: var(--seven); } .series-8 { --own: var(--eight); } [class*="series-"] { stroke: var(--own); }
svg .mark { fill: var(--page); stroke-width: 1.6; } svg .mark.best { fill: var(--own); }
ul { padding-left: 1.4rem; font-size: .9rem; }
ol { padding-left: 1.4rem; font-size: .85rem; } li { margin: .4rem 0; }
)css";
}  // namespace

std::string html_page(const std::string& title, const std::string& body) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, "
      "initial-scale=1\">\n<title>{}</title>\n<style>{}</style>\n"
      "</head>\n<body>\n{}</body>\n</html>\n",
      escape_html(title), style, body);
}

}  // namespace triptych
