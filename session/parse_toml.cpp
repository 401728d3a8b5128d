#include "session/parse_toml.hpp"

#include "base/error.hpp"
#include "base/one_line.hpp"

#include <array>
#include <cctype>

namespace triptych {

namespace {

/// What the parser says of a fault: within what, and why.
struct Said {
  std::string within, why;
};

Said split(std::string_view description) {
  constexpr std::string_view beginning = "Error while parsing ";
  const size_t colon = description.find(": ");
  if (!description.starts_with(beginning) || colon == std::string_view::npos)
    return {"", std::string(description)};
  return {std::string(description.substr(beginning.size(), colon - beginning.size())),
          std::string(description.substr(colon + 2))};
}

/// What the parser calls by words of its own.
std::string renamed(std::string text) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 8> names = {
      {{"bare key starting character or string delimiter", "a name"},
       {"value-terminator", "the end of the value"},
       {"a comment or whitespace", "the end of the line"},
       {"keys, tables, whitespace or comments", "a name or [a table]"},
       {"value or closing", "a value or"},
       {"comma or closing", "a comma or"},
       {"EOF", "the end of the file"},
       {"'\\n'", "the end of the line"}}};
  for (const auto& [theirs, ours] : names) {
    if (const size_t at = text.find(theirs); at != std::string::npos) text.replace(at, theirs.size(), ours);
  }
  const bool is_bare = !text.empty() && std::isalnum(static_cast<unsigned char>(text.front())) != 0 &&
                       !text.starts_with("a ") && !text.starts_with("the ");
  if (!is_bare) return text;
  return (std::string_view("aeiou").find(text.front()) == std::string_view::npos ? "a " : "an ") + text;
}

std::string in_words(const Said& said) {
  const std::string& why = said.why;
  const auto says = [&](std::string_view words) { return why.find(words) != std::string::npos; };
  // A word without quotes is taken for what its first letter begins.
  if (says("determine value type") ||
      (says("expected '") && (said.within == "boolean" || said.within == "floating-point")))
    return "a value is expected; text stands in quotes, as in device = \"cpu\"";
  if (says("end-of-file")) return "the file ends before what begins here does";
  if (says("control character"))
    return "no control character may stand here, nor the end of a line within a text in single quotes";
  if (says("cannot redefine") || says("cannot insert")) {
    const size_t begin = why.find('\''), end = why.find('\'', begin + 1);
    if (end == std::string::npos) return "a name stands here for the second time";
    return fmt::format("\"{}\" stands here for the second time", why.substr(begin + 1, end - begin - 1));
  }
  constexpr std::string_view expected = "expected ", saw = ", saw ";
  const size_t at = why.find(expected), then = why.rfind(saw);
  if (at == std::string::npos || then == std::string::npos) return renamed(why);
  const size_t from = at + expected.size();
  const bool is_number =
      said.within.find("integer") != std::string::npos || said.within.find("float") != std::string::npos ||
      said.within.find("date") != std::string::npos || said.within.find("time") != std::string::npos;
  return fmt::format("{} is expected, not {}{}", renamed(why.substr(from, then - from)),
                     renamed(why.substr(then + saw.size())), is_number ? "; text stands in quotes" : "");
}

}  // namespace

toml::table parse_toml(std::string_view text, const std::string& place) {
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    const toml::source_position at = error.source().begin;
    fail(place, "line {}, column {}: is no TOML: {}", at.line, at.column,
         one_line(in_words(split(error.description()))));
  }
}

}  // namespace triptych
