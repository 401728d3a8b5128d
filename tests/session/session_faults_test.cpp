// The checks of a session can fail: faults that are put in on purpose are found out.
#include "tests/session/scene_files.hpp"

namespace triptych::test {
namespace {

using SessionFaults = SceneFiles;

TEST_F(SessionFaults, a_withheld_id_fails_the_comparison) {
  const std::string line = failure(measure({"--inject", "withheld-id"}));
  EXPECT_NE(line.find("is not the un-culled picture"), std::string::npos) << line;
  const nlohmann::json report = json_of(json);
  EXPECT_EQ(report["frames_compared"], frame_count);
  EXPECT_LT(report["identical_frames"].get<size_t>(), frame_count);
  EXPECT_EQ(report["digest_mismatches"], 0) << "the sender means what it sends";
}

TEST_F(SessionFaults, a_wrong_delta_is_refused_by_its_digest_and_never_shown) {
  run(measure({"--inject", "wrong-delta"}));
  const nlohmann::json report = json_of(json);
  EXPECT_GT(report["digest_mismatches"].get<size_t>(), 0u);
  EXPECT_EQ(report["identical_frames"], frame_count);
  EXPECT_EQ(report["frames_compared"], frame_count);
}

TEST_F(SessionFaults, a_wrong_delta_without_digests_changes_the_picture) {
  failure(measure({"--inject", "wrong-delta", "--inject", "no-digest"}));
  const nlohmann::json report = json_of(json);
  EXPECT_EQ(report["digest_mismatches"], 0);
  EXPECT_LT(report["identical_frames"].get<size_t>(), frame_count);
}

TEST_F(SessionFaults, an_unknown_subcommand_is_a_usage_error_that_names_it) {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"bild"}, {"bild", "--help"}, {"measure", "bild"}}) {
    Program program(words);
    EXPECT_EQ(program.wait(), 2);
    EXPECT_NE(program.errors().find("there is no subcommand \"bild\""), std::string::npos)
        << program.errors();
  }
}

TEST_F(SessionFaults, a_usage_error_is_one_line_that_names_the_command) {
  for (const auto& [words, line] : {std::pair<std::vector<std::string>, std::string>{{}, "triptych: "},
                                    {{"build"}, "triptych build: input is required"},
                                    {{"measure", "build"}, "triptych measure build: input is required"},
                                    {{"info", "a.tpk", "--bild"}, "triptych info: "}}) {
    Program program(words);
    EXPECT_EQ(program.wait(), 2);
    const std::string errors = program.errors();
    EXPECT_EQ(errors.rfind(line, 0), 0u) << errors;
    EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'), 1) << errors;
  }
}

TEST_F(SessionFaults, an_unknown_fault_is_a_usage_error) {
  Program program(session({"--inject", "no-such-fault"}));
  EXPECT_EQ(program.wait(), 2);
}

}  // namespace
}  // namespace triptych::test
