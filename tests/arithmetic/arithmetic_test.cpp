// Cuts and bounds do not depend on compiler, optimisation, processor, locale or the rounding mode around our
// calls.
#include <array>
#include <cstdio>
#include <gtest/gtest.h>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace triptych {
namespace {

std::vector<std::string> programs() {
  std::vector<std::string> found;
  std::istringstream in(ARITHMETIC_PROGRAMS);
  for (std::string program; std::getline(in, program, '|');) found.push_back(program);
  return found;
}

/// What the command prints; empty where it fails.
std::string output_of(const std::string& command) {
  FILE* const pipe = ::popen((command + " 2>/dev/null").c_str(), "r");
  std::string text;
  std::array<char, 4096> block;
  while (const size_t count = std::fread(block.data(), 1, block.size(), pipe))
    text.append(block.data(), count);
  return ::pclose(pipe) == 0 ? text : "";
}

TEST(Arithmetic, is_the_same_for_every_compiler_and_option) {
  const std::string expected = output_of(programs().front());
  EXPECT_GT(expected.size(), 100u);
  EXPECT_GE(programs().size(), 3u);
  for (const std::string& program : programs()) EXPECT_EQ(output_of(program), expected) << program;
}

TEST(Arithmetic, is_the_same_under_every_rounding_mode_around_it) {
  for (const std::string& program : programs()) {
    const std::string expected = output_of(program);
    for (const std::string mode : {"upward", "downward", "zero"})
      EXPECT_EQ(output_of(program + " " + mode), expected) << program << " " << mode;
  }
}

TEST(Arithmetic, is_the_same_in_a_language_with_a_decimal_comma) {
  const std::string german = "LOCPATH=" LOCALES " " + programs()[1] + " nearest de_DE.UTF-8";
  EXPECT_EQ(output_of(german), output_of(programs()[1]));
}

}  // namespace
}  // namespace triptych
