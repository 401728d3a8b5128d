// What `--help` says of flags whose value is one of a few words.
#include "launch/command.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

TEST(Help, lists_the_words_of_a_flag_and_nothing_of_how_they_are_stored) {
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

TEST(Help, numbers_are_not_taken_for_words) {
  CLI::App app;
  Action action;
  add_selftest(app, action);
  EXPECT_THROW(app.parse("selftest --context 1", false), CLI::ValidationError);
  EXPECT_NO_THROW(app.parse("selftest --context osmesa", false));
}

}  // namespace
}  // namespace triptych
