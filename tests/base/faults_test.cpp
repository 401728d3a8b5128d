// What is said of JSON and XML that cannot be read.
#include "base/error.hpp"
#include "base/parse_json.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

using nlohmann::json;

TEST(JsonFault, says_where_what_is_expected_and_what_was_found) {
  const std::vector<std::pair<std::string, std::string>> faults = {
      {"", "is no JSON: it is empty"},
      {" \n ", "is no JSON: it is empty"},
      {"{\"a\": 1", "line 1, column 8: is no JSON: a comma or } is expected, not the end of the text"},
      {"{\n  \"eye\": [1, 2, 3]\n  \"target\": [1]\n}",
       "line 3, column 3: is no JSON: a comma or } is expected, not \"target\""},
      {"{\"a\" 1}", "line 1, column 6: is no JSON: a colon is expected, not 1"},
      {"{\"a\": }", "line 1, column 7: is no JSON: a value is expected, not }"},
      {"{a: 1}", "line 1, column 2: is no JSON: a name in quotes or } is expected, not a"},
      {"{\"a\": 1,}",
       "line 1, column 9: is no JSON: a name in quotes is expected, not }; no comma stands before it"},
      {"[1, 2,\n]", "line 2, column 1: is no JSON: a value is expected, not ]; no comma stands before it"},
      {"[,]", "line 1, column 2: is no JSON: a value or ] is expected, not ,"},
      {"[1 2]", "line 1, column 4: is no JSON: a comma or ] is expected, not 2"},
      {"[01]", "line 1, column 3: is no JSON: a comma or ] is expected, not 1; numbers do not begin with 0"},
      {"[1.]",
       "line 1, column 2: is no JSON: a value or ] is expected, not 1., which is no number, or too large a "
       "one"},
      {"[0, 1e999]",
       "line 1, column 5: is no JSON: a value is expected, not 1e999, which is no number, or too large a "
       "one"},
      {"[NaN]", "line 1, column 2: is no JSON: a value or ] is expected, not NaN; numbers are finite"},
      {"[True]",
       "line 1, column 2: is no JSON: a value or ] is expected, not True; it is true, false and null in "
       "small letters"},
      {"['a']",
       "line 1, column 2: is no JSON: a value or ] is expected, not '; texts and names stand in double "
       "quotes"},
      {"[1] // all", "line 1, column 5: is no JSON: the end is expected, not /; JSON has no comments"},
      {"{} {}", "line 1, column 4: is no JSON: the end is expected, not {"},
      {"[1]]", "line 1, column 4: is no JSON: the end is expected, not ]"},
      {"[\"C:\\models\"]",
       "line 1, column 5: is no JSON: \\m is not known; a backslash itself is written \\\\"},
      {"[\"a\n, 1]", "line 1, column 2: is no JSON: the text that begins here has no quote at its end"},
      {"[\"ab", "line 1, column 2: is no JSON: the text that begins here has no quote at its end"},
      {"[\"a\tb\"]", "line 1, column 4: is no JSON: a control character stands in a text"},
      {"[\"\xe9t\xe9\"]",
       "line 1, column 4: is no JSON: a text has bytes that are not UTF-8; save it as UTF-8"},
      {"[\"\\u12g4\"]",
       "line 1, column 7: is no JSON: \\u takes four hexadecimal digits, and beyond FFFF comes in pairs"},
      {"\xff\xfe[\0", "is no JSON: it is UTF-16; save it as UTF-8"},
      // Columns count letters, a byte order mark is none.
      {"[\"été\" x]", "line 1, column 8: is no JSON: a comma or ] is expected, not x"},
      {"\xef\xbb\xbfx", "line 1, column 1: is no JSON: a value is expected, not x"},
      {"[abcdefghijklmnopqrstuvwxyz]",
       "line 1, column 2: is no JSON: a value or ] is expected, not abcdefghijklmnopqrst…"}};
  for (const auto& [text, said] : faults) EXPECT_EQ(json_fault(text), said) << text;
}

TEST(JsonFault, is_none_in_json) {
  for (const char* text : {"{}", "0", "-0.5e3", " [1, 2.0, \"\\u00e9\", {\"a\": null}] ", "\xef\xbb\xbf[]"})
    EXPECT_EQ(json_fault(text), "") << text;
}

TEST(JsonFault, is_found_wherever_json_is_cut_or_changed) {
  const std::string good = R"({"a": [1, -2.5e3, 100, "x\n\u00e9"], "b": {"c": [true, null]}})";
  for (size_t at = 0; at < good.size(); ++at) {
    for (const std::string& text :
         {good.substr(0, at), good.substr(at), good.substr(0, at) + "\x01" + good.substr(at + 1),
          good.substr(0, at) + good.substr(at + 1)}) {
      const bool is_json = json::accept(text);
      EXPECT_EQ(json_fault(text).empty(), is_json) << text;
      EXPECT_EQ(json_fault(text).find("json."), std::string::npos) << text;
    }
  }
}

TEST(JsonFault, is_an_error_with_its_place) {
  EXPECT_EQ(parse_json("[1]", "a.json"), json({1}));
  try {
    parse_json("[1", "a.json");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "a.json: line 1, column 3: is no JSON: a comma or ] is expected, not the end of the text");
  }
}

std::string said_of(const std::function<void(const json&)>& use) {
  try {
    use(json::parse(R"({"a": "text", "b": [1]})"));
  } catch (const json::exception& error) {
    return in_words(error);
  }
  return "";
}

TEST(JsonFault, of_values_of_other_kinds_is_in_words) {
  EXPECT_EQ(said_of([](const json& value) { value.at("frames").get<int>(); }), "it has no \"frames\"");
  EXPECT_EQ(said_of([](const json& value) { value.at("a").get<double>(); }),
            "it has a text where a number is expected");
  EXPECT_EQ(said_of([](const json& value) { value.at("b").get<std::string>(); }),
            "it has a list where a text is expected");
  EXPECT_EQ(said_of([](const json& value) { value.at("b").at(7).get<int>(); }),
            "it has not the values that it needs");
}

}  // namespace
}  // namespace triptych
