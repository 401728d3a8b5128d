#include "base/parse_json.hpp"

#include "base/error.hpp"
#include "base/one_line.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <sstream>

namespace triptych {

namespace {

using nlohmann::json;

constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

bool is_blank(char letter) { return letter == ' ' || letter == '\t' || letter == '\n' || letter == '\r'; }
bool is_of_word(char letter) {
  const auto byte = static_cast<unsigned char>(letter);
  return std::isalnum(byte) != 0 || byte >= 0x80 || letter == '_' || letter == '.' || letter == '+' ||
         letter == '-';
}
bool is_letter_begin(char letter) { return (static_cast<unsigned char>(letter) & 0xc0) != 0x80; }

std::string place_in(std::string_view text, size_t at) {
  const std::string_view before = text.substr(0, at);
  const size_t line_end = before.rfind('\n');
  std::string_view line = before.substr(line_end == std::string_view::npos ? 0 : line_end + 1);
  if (line_end == std::string_view::npos && line.starts_with(byte_order_mark))
    line.remove_prefix(byte_order_mark.size());
  return fmt::format("line {}, column {}", std::count(before.begin(), before.end(), '\n') + 1,
                     std::count_if(line.begin(), line.end(), is_letter_begin) + 1);
}

/// Follows the parser to where it stops, so that it is known what may stand there.
class FaultFinder : public nlohmann::json_sax<json> {
 public:
  explicit FaultFinder(std::string_view text) : text_(text), stream_(std::string(text)) {}

  /// What is wrong where the parser stopped, and its place.
  std::string fault() {
    if (json::sax_parse(stream_, this)) return "";
    read_ = read();
    if (text_.starts_with("\xff\xfe") || text_.starts_with("\xfe\xff"))
      return "is no JSON: it is UTF-16; save it as UTF-8";
    const size_t at = skip_to_fault();
    if (at >= text_.size() && last_ == Last::nothing) return "is no JSON: it is empty";
    if (at < text_.size() && text_[at] == '"' && said_.find("invalid string") != std::string::npos) {
      const auto [inside, what] = fault_in_quotes(at);
      return fmt::format("{}: is no JSON: {}", place_in(text_, inside), what);
    }
    return fmt::format("{}: is no JSON: {} is expected, not {}{}", place_in(text_, at), expected(), found(at),
                       hint(at));
  }

  bool null() override { return value(); }
  bool boolean(bool) override { return value(); }
  bool number_integer(number_integer_t number) override { return this->number(number == 0); }
  bool number_unsigned(number_unsigned_t number) override { return this->number(number == 0); }
  bool number_float(number_float_t, const string_t&) override { return number(false); }
  bool string(string_t&) override { return value(); }
  bool binary(binary_t&) override { return value(); }
  bool start_object(std::size_t) override { return begin_list('}', Last::object_begin); }
  bool start_array(std::size_t) override { return begin_list(']', Last::array_begin); }
  bool end_object() override { return end_list(); }
  bool end_array() override { return end_list(); }
  bool key(string_t&) override { return pass(Last::name); }
  bool parse_error(std::size_t, const std::string&, const json::exception& error) override {
    said_ = error.what();
    return false;
  }

 private:
  enum class Last { nothing, object_begin, array_begin, name, value };

  /// Bytes that the parser has read.
  size_t read() { return static_cast<size_t>(stream_.rdbuf()->pubseekoff(0, std::ios::cur, std::ios::in)); }
  bool pass(Last last) {
    last_ = last;
    good_ = read();
    return true;
  }
  bool value() { return pass(Last::value); }
  /// The parser has read one letter beyond it, if there is one.
  bool number(bool is_zero) {
    value();
    const auto is_digit = [&](size_t at) { return std::isdigit(static_cast<unsigned char>(text_[at])) != 0; };
    if (!is_digit(good_ - 1) || (is_zero && good_ > 1 && is_digit(good_ - 2))) --good_;
    return true;
  }
  bool begin_list(char end, Last last) {
    ends_.push_back(end);
    return pass(last);
  }
  bool end_list() {
    ends_.pop_back();
    return value();
  }

  /// Where what cannot be read begins, behind the comma or colon that may stand before it.
  size_t skip_to_fault() {
    size_t at = last_ == Last::nothing && text_.starts_with(byte_order_mark) ? byte_order_mark.size() : good_;
    const auto skip_blanks = [&] {
      while (at < text_.size() && is_blank(text_[at])) ++at;
    };
    skip_blanks();
    const char separator = last_ == Last::name ? ':' : last_ == Last::value && !ends_.empty() ? ',' : '\0';
    separated_ = separator != '\0' && at < text_.size() && text_[at] == separator;
    if (separated_) {
      ++at;
      skip_blanks();
    }
    return at;
  }

  std::string expected() const {
    const char end = ends_.empty() ? '\0' : ends_.back();
    switch (last_) {
      case Last::object_begin:
        return "a name in quotes or }";
      case Last::array_begin:
        return "a value or ]";
      case Last::name:
        return separated_ ? "a value" : "a colon";
      case Last::value:
        if (end == '\0') return "the end";
        if (separated_) return end == '}' ? "a name in quotes" : "a value";
        return fmt::format("a comma or {}", end);
      default:
        return "a value";
    }
  }

  std::string found(size_t at) const {
    if (at >= text_.size()) return "the end of the text";
    constexpr size_t most = 20;
    size_t end = at + 1;
    if (text_[at] == '"') {
      while (end < text_.size() && text_[end] != '"') end += text_[end] == '\\' ? 2 : 1;
      end = std::min(end + 1, text_.size());
    } else if (is_of_word(text_[at])) {
      while (end < text_.size() && is_of_word(text_[end])) ++end;
    }
    size_t shown = std::min(end, at + most);
    while (shown < end && shown > at && !is_letter_begin(text_[shown])) --shown;
    return one_line(std::string(text_.substr(at, shown - at))) + (shown < end ? "…" : "");
  }

  /// What people mean where other languages are used to it.
  std::string hint(size_t at) const {
    if (at >= text_.size()) return "";
    const std::string word = found(at);
    const bool closes = word == "}" || word == "]";
    if (closes && separated_ && last_ == Last::value) return "; no comma stands before it";
    if (word == "'") return "; texts and names stand in double quotes";
    if (word == "/" || word == "#") return "; JSON has no comments";
    if (word == "NaN" || word == "nan" || word.ends_with("Infinity") || word.ends_with("inf"))
      return "; numbers are finite";
    if (word == "True" || word == "False" || word == "None")
      return "; it is true, false and null in small letters";
    const bool is_number = std::isdigit(static_cast<unsigned char>(word.front())) != 0 || word.front() == '-';
    if (is_number && at > 0 && text_[at - 1] == '0') return "; numbers do not begin with 0";
    if (is_number && expected().starts_with("a value")) return ", which is no number, or too large a one";
    return "";
  }

  /// What is wrong within the text in quotes that begins there, and where. The parser has read up to it.
  std::pair<size_t, std::string> fault_in_quotes(size_t begin) const {
    const auto says = [&](const char* words) { return said_.find(words) != std::string::npos; };
    const size_t last = read_ - 1;
    if (says("closing quote") || text_[last] == '\n' || text_[last] == '\r')
      return {begin, "the text that begins here has no quote at its end"};
    if (says("control character")) return {last, "a control character stands in a text"};
    if (says("UTF-8")) return {last, "a text has bytes that are not UTF-8; save it as UTF-8"};
    if (says("after backslash"))
      return {last - 1, fmt::format("\\{} is not known; a backslash itself is written \\\\",
                                    one_line(std::string(1, text_[last])))};
    return {last, "\\u takes four hexadecimal digits, and beyond FFFF comes in pairs"};
  }

  std::string_view text_;
  std::istringstream stream_;
  size_t read_ = 0;  ///< bytes of the text, when the parser stopped
  size_t good_ = 0;  ///< of them up to the end of the last name, value, [ or {
  Last last_ = Last::nothing;
  std::string ends_;  ///< of the lists and objects that are open
  bool separated_ = false;
  std::string said_;  ///< by the parser
};

/// A kind of value, as the library names it, in words.
std::string kind_in_words(const std::string& kind) {
  static const std::map<std::string, std::string> words = {{"null", "nothing"},  {"boolean", "true or false"},
                                                           {"string", "a text"}, {"number", "a number"},
                                                           {"array", "a list"},  {"object", "an object"}};
  const auto found = words.find(kind);
  return found == words.end() ? "another kind of value" : found->second;
}

/// What stands behind the first of these words, up to the second ones, or to the end.
std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const size_t at = text.find(begin);
  if (at == std::string::npos) return "";
  const size_t from = at + begin.size(), to = text.find(end, from);
  return text.substr(from, to == std::string::npos ? to : to - from);
}

}  // namespace

json parse_json(std::string_view text, const std::string& place) {
  json value = json::parse(text, nullptr, false);
  if (value.is_discarded()) throw Error(place, json_fault(text));
  return value;
}

std::string json_fault(std::string_view text) { return FaultFinder(text).fault(); }

std::string in_words(const json::exception& error) {
  constexpr int wrong_kind = 302, no_member = 403;
  const std::string said = error.what();
  if (error.id == no_member)
    return fmt::format("it has no \"{}\"", one_line(between(said, "key '", "' not")));
  if (error.id == wrong_kind)
    return fmt::format("it has {} where {} is expected", kind_in_words(between(said, "but is ", " ")),
                       kind_in_words(between(said, "must be ", ",")));
  return "it has not the values that it needs";
}

}  // namespace triptych
