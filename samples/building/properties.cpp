#include "samples/building/properties.hpp"

#include "base/error.hpp"

#include <charconv>
#include <cstdint>

namespace triptych {
namespace {

bool blank(char c) { return c == ' ' || c == '\t' || c == '\f'; }

void append_utf8(std::string& text, uint32_t code) {
  if (code < 0x80) {
    text += static_cast<char>(code);
  } else if (code < 0x800) {
    text += static_cast<char>(0xc0 | (code >> 6));
    text += static_cast<char>(0x80 | (code & 0x3f));
  } else if (code < 0x10000) {
    text += static_cast<char>(0xe0 | (code >> 12));
    text += static_cast<char>(0x80 | ((code >> 6) & 0x3f));
    text += static_cast<char>(0x80 | (code & 0x3f));
  } else {
    text += static_cast<char>(0xf0 | (code >> 18));
    text += static_cast<char>(0x80 | ((code >> 12) & 0x3f));
    text += static_cast<char>(0x80 | ((code >> 6) & 0x3f));
    text += static_cast<char>(0x80 | (code & 0x3f));
  }
}

class Parser {
 public:
  Parser(std::string_view text, const std::string& place) : text_(text), place_(place) {}

  std::map<std::string, std::string> parse() {
    std::map<std::string, std::string> entries;
    while (skip_to_entry()) {
      std::string key = token(true);
      skip_blanks();
      if (at_ < text_.size() && (text_[at_] == '=' || text_[at_] == ':')) ++at_;
      skip_blanks();
      entries[std::move(key)] = token(false);
    }
    return entries;
  }

 private:
  bool at_line_end() const { return at_ >= text_.size() || text_[at_] == '\n' || text_[at_] == '\r'; }

  void skip_line_end() {
    if (at_ < text_.size() && text_[at_] == '\r') ++at_;
    if (at_ < text_.size() && text_[at_] == '\n') ++at_;
    ++line_;
  }

  void skip_blanks() {
    for (;;) {
      while (at_ < text_.size() && blank(text_[at_])) ++at_;
      if (!skip_continuation()) return;
    }
  }

  // A backslash before a line's end joins the next line, without its indentation.
  bool skip_continuation() {
    if (at_ + 1 >= text_.size() || text_[at_] != '\\') return false;
    if (text_[at_ + 1] != '\n' && text_[at_ + 1] != '\r') return false;
    ++at_;
    skip_line_end();
    while (at_ < text_.size() && blank(text_[at_])) ++at_;
    return true;
  }

  bool skip_to_entry() {
    while (at_ < text_.size()) {
      while (at_ < text_.size() && blank(text_[at_])) ++at_;
      if (at_ < text_.size() && (text_[at_] == '#' || text_[at_] == '!')) {
        while (!at_line_end()) ++at_;
      }
      if (at_ >= text_.size()) return false;
      if (!at_line_end()) return true;
      skip_line_end();
    }
    return false;
  }

  std::string token(bool key) {
    std::string result;
    while (!at_line_end()) {
      if (skip_continuation()) continue;
      const char c = text_[at_];
      if (key && (c == '=' || c == ':' || blank(c))) break;
      ++at_;
      if (c == '\\') {
        append_escape(result);
      } else {
        append_utf8(result, static_cast<unsigned char>(c));
      }
    }
    return result;
  }

  void append_escape(std::string& result) {
    if (at_ >= text_.size()) return;
    const char c = text_[at_++];
    switch (c) {
      case 't':
        result += '\t';
        break;
      case 'n':
        result += '\n';
        break;
      case 'r':
        result += '\r';
        break;
      case 'f':
        result += '\f';
        break;
      case 'u':
        append_utf8(result, code_point());
        break;
      default:
        append_utf8(result, static_cast<unsigned char>(c));
    }
  }

  uint32_t code_unit() {
    uint32_t unit = 0;
    const char* begin = text_.data() + at_;
    const size_t left = text_.size() - at_;
    if (left < 4 || std::from_chars(begin, begin + 4, unit, 16).ptr != begin + 4)
      fail(place_, "line {}: \\u needs four hexadecimal digits", line_);
    at_ += 4;
    return unit;
  }

  uint32_t code_point() {
    const uint32_t high = code_unit();
    if (high < 0xd800 || high > 0xdfff) return high;
    if (high > 0xdbff || text_.substr(at_, 2) != "\\u")
      fail(place_, "line {}: half of a surrogate pair", line_);
    at_ += 2;
    const uint32_t low = code_unit();
    if (low < 0xdc00 || low > 0xdfff) fail(place_, "line {}: half of a surrogate pair", line_);
    return 0x10000 + ((high - 0xd800) << 10) + (low - 0xdc00);
  }

  std::string_view text_;
  const std::string& place_;
  size_t at_ = 0;
  int line_ = 1;
};

}  // namespace

std::map<std::string, std::string> parse_properties(std::string_view text, const std::string& place) {
  return Parser(text, place).parse();
}

}  // namespace triptych
