// What is said of TOML that cannot be read.
#include "session/parse_toml.hpp"

#include "base/error.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

std::string said_of(const std::string& text) {
  try {
    parse_toml(text, "t.toml");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(ParseToml, says_in_words_what_is_expected_and_what_was_found) {
  const std::string quotes = "a value is expected; text stands in quotes, as in device = \"cpu\"";
  const std::vector<std::pair<std::string, std::string>> faults = {
      {"a = 1\ndevice = cpu\n", "line 2, column 10: is no TOML: " + quotes},
      {"device = fly\n", "line 1, column 11: is no TOML: " + quotes},
      {"device = no\n", "line 1, column 11: is no TOML: " + quotes},
      {"size = 100x100\n",
       "line 1, column 11: is no TOML: a digit is expected, not 'x'; text stands in quotes"},
      {"size = \n", "line 1, column 8: is no TOML: a value is expected, not the end of the line"},
      {"size\n", "line 1, column 5: is no TOML: '=' is expected, not the end of the line"},
      {"= 3\n", "line 1, column 1: is no TOML: a name or [a table] is expected, not '='"},
      {"a = [1 2]\n", "line 1, column 8: is no TOML: a comma or ']' is expected, not '2'"},
      {"a = 'x\n",
       "line 1, column 7: is no TOML: no control character may stand here, nor the end of a line within a "
       "text in single quotes"},
      {"a = 1\na = 2\n", "line 2, column 5: is no TOML: \"a\" stands here for the second time"},
      {"[render]\n[render]\n", "line 2, column 1: is no TOML: \"render\" stands here for the second time"},
      {"a = 1 b = 2\n", "line 1, column 7: is no TOML: the end of the line is expected, not 'b'"}};
  for (const auto& [text, said] : faults) EXPECT_EQ(said_of(text), "t.toml: " + said) << text;
}

TEST(ParseToml, never_speaks_as_its_parser_does) {
  const std::string good =
      "a = 1.5\n[b.c]\nd = [1, 'x', \"y\\n\"]\ne = { f = true }\n# all\ng = 2020-01-02\n";
  EXPECT_EQ(said_of(good), "");
  size_t faults = 0;
  for (size_t at = 0; at < good.size(); ++at) {
    for (const char* put : {"", "=", "\"", "\x01", "[", "\n", "_", ",", "9"}) {
      const std::string said = said_of(good.substr(0, at) + put + good.substr(at + 1));
      faults += said.empty() ? 0 : 1;
      for (const char* theirs :
           {"Error while", "toml::", "value-terminator", "saw ", "EOF", "redefine", "encountered"})
        EXPECT_EQ(said.find(theirs), std::string::npos) << said;
      EXPECT_TRUE(said.empty() || said.starts_with("t.toml: line ")) << said;
    }
  }
  EXPECT_GT(faults, 100u);
}

}  // namespace
}  // namespace triptych
