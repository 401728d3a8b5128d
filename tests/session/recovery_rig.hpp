// Sessions that lose roles: what they play, and what must be true of their pictures.
#pragma once

#include "tests/session/scene_files.hpp"

namespace triptych::test {

class SessionRecovery : public SceneFiles {
 protected:
  static constexpr int rounds = 8;

  /// A few seconds long, with a hash of each picture.
  std::vector<std::string> walk(std::vector<std::string> more = {}, int loop = rounds) const {
    return with(session({"--loop", std::to_string(loop), "--rate", "150", "--hash", "--json", json}),
                std::move(more));
  }
  /// The same without an end: for what takes as long as it takes.
  std::vector<std::string> endless(std::vector<std::string> more = {}) const {
    return with(session({"--until-told", "--rate", "150", "--hash", "--json", json}), std::move(more));
  }
  /// The same path undisturbed, once.
  nlohmann::json right_pictures() const {
    const std::string file = folder.file("undisturbed.json");
    run(session({"--hash", "--json", file, "--timeout", "60000"}));
    return json_of(file)["pictures"];
  }
  /// Every frame is there, and is what it is without faults.
  void expect_right_pictures(const nlohmann::json& pictures, size_t loop = rounds) const {
    const nlohmann::json right = right_pictures();
    ASSERT_EQ(pictures.size(), loop * frame_count);
    size_t wrong = 0;
    for (size_t i = 0; i < pictures.size(); ++i) wrong += pictures[i] != right[i % frame_count];
    EXPECT_EQ(wrong, 0u);
  }
  /// The same of as many frames as there are.
  void expect_only_right_pictures(const nlohmann::json& pictures) const {
    const nlohmann::json right = right_pictures();
    size_t wrong = 0;
    for (size_t i = 0; i < pictures.size(); ++i) wrong += pictures[i] != right[i % frame_count];
    EXPECT_EQ(wrong, 0u) << "of " << pictures.size();
    EXPECT_GT(pictures.size(), 0u);
  }
  /// An endless session lost a switch node, and gets it back, however long that takes; then it is told to
  /// end, and ends well.
  void expect_recovery(Program& program) const {
    wait_for(program, "both switch nodes are back");
    wait(std::chrono::milliseconds(200));
    program.signal(SIGTERM);
    ASSERT_EQ(program.wait(), 0) << program.errors();
    EXPECT_FALSE(program.anybody_left());
    const nlohmann::json report = json_of(json);
    EXPECT_GE(report["fallback_frames"], 1);
    EXPECT_LT(report["fallback_frames"].get<size_t>(), report["frames"].get<size_t>());
    EXPECT_EQ(report["digest_mismatches"], 0);
    expect_only_right_pictures(report["pictures"]);
  }
  static void wait(std::chrono::milliseconds time) { std::this_thread::sleep_for(time); }
  /// Frames are being drawn: both switch nodes have culled.
  void wait_until_under_way(const Program& program) const {
    for (const char* role : {"render", "switch 0", "switch 1"}) ASSERT_GT(program.role(role), 0);
    wait_for(program, "both switch nodes are here");
    wait(std::chrono::milliseconds(500));
  }
  /// Until it says so, so many times.
  static void wait_for(const Program& program, const std::string& words, size_t times = 1) {
    const auto said = [&] {
      const std::string text = program.errors();
      size_t count = 0;
      for (size_t at = 0; (at = text.find(words, at)) != std::string::npos; ++at) ++count;
      return count;
    };
    for (int tries = 0; said() < times; ++tries) {
      ASSERT_LT(tries, 6000) << "not said: " << words << "\n" << program.errors();
      wait(std::chrono::milliseconds(10));
    }
  }
};

}  // namespace triptych::test
