// What every command line has in common: the words of its flags, and which numbers are none.
#include "launch/command.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

TEST(CommandLine, help_lists_the_words_of_a_flag_and_nothing_of_how_they_are_stored) {
  CLI::App app;
  Action action;
  for (const auto add : {add_build, add_render, add_session, add_replay, add_role, add_selftest, add_measure})
    add(app, action);
  const std::string help = app.help("", CLI::AppFormatMode::All);
  EXPECT_NE(help.find("--context egl|osmesa=egl"), std::string::npos);
  EXPECT_NE(help.find("--test queries|storage=storage"), std::string::npos);
  EXPECT_NE(help.find("--cull frustum|none|occlusion=occlusion"), std::string::npos);
  EXPECT_NE(help.find("--up y|z=y"), std::string::npos);
  EXPECT_EQ(help.find('{'), std::string::npos);
  EXPECT_EQ(help.find("->"), std::string::npos);
}

TEST(CommandLine, numbers_are_not_taken_for_words) {
  CLI::App app;
  Action action;
  add_selftest(app, action);
  EXPECT_THROW(app.parse("selftest --context 1", false), CLI::ValidationError);
  EXPECT_NO_THROW(app.parse("selftest --context osmesa", false));
}

TEST(CommandLine, times_and_rates_are_finite_numbers_above_0) {
  for (const std::string flag : {"--timeout", "--rate"}) {
    for (const std::string value : {"nan", "inf", "0", "-1"}) {
      CLI::App app;
      Action action;
      add_session(app, action);
      EXPECT_THROW(app.parse("session pack.tpk --path walk.json " + flag + " " + value, false),
                   CLI::ValidationError)
          << flag << " " << value;
    }
  }
}

}  // namespace
}  // namespace triptych
