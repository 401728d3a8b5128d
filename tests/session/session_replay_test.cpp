// A recorded session shows its frames again, bit for bit, from its messages alone.
#include "scene/pack_objects.hpp"
#include "tests/session/scene_files.hpp"

#include <set>

namespace triptych::test {
namespace {

class SessionReplay : public SceneFiles {
 protected:
  const std::string recording = folder.file("recording"), pictures = folder.file("pictures"),
                    again = folder.file("again");

  void record(std::vector<std::string> more = {}) const {
    run(with(session({"--record", recording, "-o", pictures}), std::move(more)));
  }
  /// In the middle of its frames.
  void kill_the_render_node(const Program& program) const {
    const pid_t victim = program.role("render");
    for (int tries = 0; tries < 6000 && !std::filesystem::exists(pictures + name(30)); ++tries) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ::kill(victim, SIGKILL);
  }
  std::string render_recording() const { return recording + "/render.recording"; }
  static std::string name(size_t frame) {
    const std::string digits = std::to_string(frame);
    return "/" + std::string(6 - digits.size(), '0') + digits + ".png";
  }
};

TEST_F(SessionReplay, shows_every_frame_as_it_was) {
  record();
  run({"replay", recording, "--frames", "all", "-o", again});
  std::set<std::string> different;
  for (size_t i = 0; i < frame_count; ++i) {
    EXPECT_EQ(text_of(again + name(i)), text_of(pictures + name(i))) << "frame " << i;
    different.insert(text_of(again + name(i)));
  }
  EXPECT_GT(different.size(), frame_count / 2) << "the path shows hardly anything";
}

TEST_F(SessionReplay, shows_frames_of_which_something_is_hidden_as_they_were) {
  scenes::write_pack_with_objects("room", pack);
  const std::vector<std::string> hide = {"--hide",    "layer:layer 2",   "--hide",    "object 1",
                                         "--isolate", "storey:storey 0", "--isolate", "storey:storey 2"};
  record(with({"--json", json}, hide));
  EXPECT_EQ(json_of(json).at("fallback_frames"), 0);
  const int hidden = json_of(json).at("hidden_objects").get<int>();
  EXPECT_GT(hidden, 2);
  const std::string replayed = folder.file("replayed.json"), alone = folder.file("alone"),
                    whole = folder.file("whole");
  run({"replay", recording, "--frames", "all", "-o", again, "--json", replayed});
  const nlohmann::json report = json_of(replayed);
  for (const auto& frame : report.at("frames")) EXPECT_EQ(frame.at("hidden"), hidden);
  const std::vector<std::string> render = {"render", pack, "--path", path, "--size", "160x120", "-o"};
  run(with(with(render, {alone}), hide));
  run(with(render, {whole}));
  size_t different = 0;
  for (size_t i = 0; i < frame_count; ++i) {
    EXPECT_EQ(text_of(again + name(i)) == text_of(pictures + name(i)), true) << "frame " << i;
    EXPECT_EQ(text_of(alone + name(i)) == text_of(pictures + name(i)), true) << "frame " << i;
    different += text_of(whole + name(i)) != text_of(pictures + name(i));
  }
  EXPECT_GT(different, frame_count / 2);
}

TEST_F(SessionReplay, a_word_that_means_nothing_is_one_line_before_any_role_starts) {
  scenes::write_pack_with_objects("room", pack);
  EXPECT_EQ(failure(session({"--hide", "layer:layr 2"})),
            "triptych: --hide: no object of " +
                std::to_string(scenes::pack_with_objects("room").read_objects().source().objects.size()) +
                " is meant by \"layer:layr 2\"; did you mean layer:layer 2?");
}

TEST_F(SessionReplay, shows_one_frame_as_it_was) {
  record();
  const size_t frame = frame_count / 2;
  run({"replay", recording, "--frame", std::to_string(frame), "-o", folder.file("x.png"), "--json", json});
  EXPECT_EQ(text_of(folder.file("x.png")), text_of(pictures + name(frame)));
  EXPECT_EQ(json_of(json).at("frames").size(), 1u);
}

TEST_F(SessionReplay, shows_frames_whose_sets_had_to_be_sent_again) {
  record({"--inject", "wrong-delta"});
  run({"replay", recording, "--frames", "all", "-o", again, "--json", json});
  const nlohmann::json report = json_of(json);
  size_t mismatches = 0;
  for (const auto& frame : report.at("frames")) mismatches += frame.at("digest_mismatch").get<bool>();
  EXPECT_GT(mismatches, 0u);
  for (size_t i = 0; i < frame_count; ++i) {
    EXPECT_EQ(text_of(again + name(i)), text_of(pictures + name(i))) << "frame " << i;
  }
}

TEST_F(SessionReplay, shows_frames_that_the_render_node_drew_alone_and_those_after_it) {
  // A switch node is killed on the way; the others go on, and it comes back. What is hidden it gets again.
  scenes::write_pack_with_objects("room", pack);
  Program program(session({"--loop", "6", "--rate", "40", "--record", recording, "-o", pictures, "--json",
                           json, "--hide", "layer:layer 1"}));
  const pid_t victim = program.role("switch 1");
  for (int tries = 0; tries < 6000 && !std::filesystem::exists(pictures + name(10)); ++tries) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ::kill(victim, SIGKILL);
  ASSERT_EQ(program.wait(), 0) << program.errors();
  EXPECT_GT(json_of(json).at("fallback_frames").get<int>(), 0) << program.errors();
  const std::string replayed = folder.file("replayed.json");
  run({"replay", recording, "--frames", "all", "-o", again, "--json", replayed});
  const nlohmann::json report = json_of(replayed);
  EXPECT_EQ(report.at("frames").size(), 6 * frame_count);
  size_t alone = 0;
  for (const auto& frame : report.at("frames")) alone += frame.at("alone").get<bool>();
  EXPECT_EQ(alone, json_of(json).at("fallback_frames").get<size_t>());
  for (size_t i = 0; i < 6 * frame_count; ++i) {
    EXPECT_EQ(text_of(again + name(i)) == text_of(pictures + name(i)), true) << "frame " << i;
  }
}

TEST_F(SessionReplay, shows_every_frame_of_a_session_whose_render_node_was_killed) {
  Program program(
      session({"--loop", "6", "--rate", "40", "--record", recording, "-o", pictures, "--json", json}));
  kill_the_render_node(program);
  ASSERT_EQ(program.wait(), 0) << program.errors();
  EXPECT_EQ(json_of(json).at("restarts"), 1);
  const std::string line = failure({"replay", recording, "--frames", "all", "-o", again});
  EXPECT_NE(line.find("render.recording byte "), std::string::npos) << line;
  EXPECT_NE(line.find("--partial"), std::string::npos) << line;
  const std::string replayed = folder.file("replayed.json");
  run({"replay", recording, "--frames", "all", "--partial", "-o", again, "--json", replayed});
  const nlohmann::json report = json_of(replayed);
  EXPECT_EQ(report.at("cut"), true);
  std::set<size_t> numbers, alone;
  for (const auto& frame : report.at("frames")) {
    numbers.insert(frame.at("number").get<size_t>());
    if (frame.at("alone").get<bool>()) alone.insert(frame.at("number").get<size_t>());
  }
  EXPECT_EQ(report.at("frames").size(), numbers.size()) << "frames come twice";
  ASSERT_EQ(numbers.size(), 6 * frame_count);
  EXPECT_LT(alone.size(), numbers.size() - 10) << "what all three roles played before is not there";
  for (size_t i = 0; i < 6 * frame_count; ++i) {
    EXPECT_EQ(text_of(again + name(i)) == text_of(pictures + name(i)), true) << "frame " << i;
  }
}

TEST_F(SessionReplay, shows_what_a_render_node_had_that_was_killed_for_good) {
  Program program(
      session({"--loop", "6", "--rate", "40", "--record", recording, "-o", pictures, "--restarts", "0"}));
  kill_the_render_node(program);
  ASSERT_EQ(program.wait(), 1) << program.errors();
  size_t whole = 0;
  for (; std::filesystem::exists(pictures + name(whole)); ++whole) {
  }
  ASSERT_GT(whole, 10u);
  ASSERT_LT(whole, 6 * frame_count);
  const auto replay = [&](size_t frame) -> std::vector<std::string> {
    return {"replay", recording, "--partial", "--frame", std::to_string(frame), "-o", folder.file("x.png")};
  };
  for (const size_t frame : {size_t{0}, whole / 2, whole - 1}) {
    run(replay(frame));
    EXPECT_EQ(text_of(folder.file("x.png")) == text_of(pictures + name(frame)), true) << "frame " << frame;
  }
  std::filesystem::remove(folder.file("x.png"));
  const size_t missing = whole + 30;  // frames may be drawn whose picture is not written
  const std::string line = failure(replay(missing));
  EXPECT_NE(line.find("frame " + std::to_string(missing) + " is not whole in the recording"),
            std::string::npos)
      << line;
  EXPECT_NE(line.find("render.recording byte "), std::string::npos) << line;
  EXPECT_FALSE(std::filesystem::exists(folder.file("x.png")));
}

TEST_F(SessionReplay, finds_the_pack_where_it_is_told) {
  record({"--frames", "3"});
  const std::string moved = folder.file("moved.tpk");
  std::filesystem::rename(pack, moved);
  const std::string line = failure({"replay", recording, "--frame", "1", "-o", folder.file("x.png")});
  EXPECT_NE(line.find("room.tpk, which is not there: --pack says where it is now"), std::string::npos)
      << line;
  run({"replay", recording, "--frame", "1", "-o", folder.file("x.png"), "--pack", moved});
  EXPECT_EQ(text_of(folder.file("x.png")), text_of(pictures + name(1)));
  scenes::write_pack("flat", moved);
  const std::string other =
      failure({"replay", recording, "--frame", "1", "-o", folder.file("x.png"), "--pack", moved});
  EXPECT_NE(other.find("another pack"), std::string::npos) << other;
}

TEST_F(SessionReplay, a_recording_that_is_cut_is_one_line_and_what_it_holds_can_be_had) {
  record();
  std::filesystem::resize_file(render_recording(), std::filesystem::file_size(render_recording()) / 2);
  const std::string line = failure({"replay", recording, "--frame", "1", "-o", folder.file("x.png")});
  EXPECT_NE(line.find("render.recording byte "), std::string::npos) << line;
  EXPECT_NE(line.find("cut"), std::string::npos) << line;
  run({"replay", recording, "--frames", "all", "-o", again, "--partial", "--json", json});
  const size_t held = json_of(json).at("frames").size();
  EXPECT_GT(held, 0u);
  EXPECT_LT(held, frame_count);
  EXPECT_EQ(text_of(again + name(held - 1)), text_of(pictures + name(held - 1)));
}

TEST_F(SessionReplay, a_recording_that_is_damaged_is_one_line) {
  record();
  std::string bytes = text_of(render_recording());
  bytes[bytes.size() / 2] ^= 4;
  std::ofstream(render_recording(), std::ios::binary) << bytes;
  const std::string line =
      failure({"replay", recording, "--frame", "1", "-o", folder.file("x.png"), "--partial"});
  EXPECT_NE(line.find("render.recording byte "), std::string::npos) << line;
}

TEST_F(SessionReplay, a_frame_or_a_recording_that_is_not_there_is_one_line) {
  const std::vector<std::string> replay = {"replay", recording, "--frame", "1", "-o", folder.file("x.png")};
  EXPECT_EQ(failure(replay), "triptych: " + recording + ": cannot be opened: No such file or directory");
  std::filesystem::create_directory(recording);
  EXPECT_NE(failure(replay).find("no recording"), std::string::npos);
  record({"--frames", "3"});
  EXPECT_NE(failure({"replay", recording, "--frame", "3", "-o", folder.file("x.png")}).find("frame 3"),
            std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder.file("x.png")));
}

TEST_F(SessionReplay, a_recording_is_not_written_over) {
  record({"--frames", "3"});
  const std::string before = text_of(render_recording());
  EXPECT_NE(failure(session({"--record", recording})).find(recording), std::string::npos);
  EXPECT_EQ(text_of(render_recording()), before);
}

}  // namespace
}  // namespace triptych::test
