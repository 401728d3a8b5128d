// Each role of a recorded session runs alone, its peers played from the recording.
#include "protocol/recording.hpp"
#include "tests/session/scene_files.hpp"

namespace triptych::test {
namespace {

class MeasureRoles : public SceneFiles {
 protected:
  const std::string recording = folder.file("recording");

  void SetUp() override { run(session({"--record", recording, "--gather", "60"})); }
  std::vector<std::string> measure() const {
    return {"measure", "roles", recording, "--rounds", "2", "--json", json};
  }
  std::string file(Role role) const { return recording + "/" + recording_name(role); }
  /// Writes the role's recording anew, with each message as `change` leaves it, or without it.
  void change(Role role, const std::function<bool(RecordedMessage&)>& change) const {
    RecordingReader reader(file(role));
    const std::string changed = folder.file("changed");
    {
      RecordingWriter writer(changed, reader.header());
      while (auto message = reader.next()) {
        if (change(*message)) writer.add(*message);
      }
    }
    std::filesystem::rename(changed, file(role));
  }
};

TEST_F(MeasureRoles, times_every_stage_of_every_role) {
  run(measure());
  const nlohmann::json report = json_of(json);
  EXPECT_EQ(report.at("frames"), frame_count);
  ASSERT_EQ(report.at("rows").size(), 6u);
  double slowest = 0;
  for (const auto& row : report.at("rows")) {
    EXPECT_GT(row.at("ms").at("p50").get<double>(), 0) << row;
    if (row.at("role") != "all in one") slowest = std::max(slowest, row.at("over_local").get<double>());
  }
  EXPECT_EQ(report.at("slowest_over_local").get<double>(), slowest);
}

TEST_F(MeasureRoles, a_role_that_was_started_again_cannot_be_played) {
  const std::string second = recording + "/" + recording_name(Role::switch_0, 2);
  std::filesystem::copy_file(file(Role::switch_0), second);
  EXPECT_EQ(failure(measure()),
            "triptych: " + second + ": the role was started again: record a session in which none is");
}

TEST_F(MeasureRoles, a_frame_that_the_render_node_drew_alone_is_named) {
  change(Role::render, [](RecordedMessage& message) {
    const auto* camera = std::get_if<CameraMessage>(&message.message);
    if (camera != nullptr && camera->frame == 3) message.peer = Role::render;
    return true;
  });
  EXPECT_EQ(failure(measure()), "triptych: " + file(Role::render) +
                                    ": frame 3 was drawn without switch nodes: record with --gather");
}

TEST_F(MeasureRoles, a_switch_node_whose_cameras_are_not_all_there_is_not_waited_for) {
  change(Role::switch_0, [](const RecordedMessage& recorded) {
    const auto* camera = std::get_if<CameraMessage>(&recorded.message);
    return camera == nullptr || camera->frame != 5;
  });
  EXPECT_EQ(failure(measure()), "triptych: " + file(Role::switch_0) + ": the camera of frame 5 is not there");
}

TEST_F(MeasureRoles, recordings_of_two_sessions_are_not_mixed) {
  const std::string other = folder.file("other");
  run(session({"--record", other, "--gather", "60"}));
  std::filesystem::copy_file(other + "/" + recording_name(Role::switch_1), file(Role::switch_1),
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_EQ(failure(measure()),
            "triptych: " + file(Role::switch_1) + ": is of another session than " + file(Role::render));
}

TEST_F(MeasureRoles, that_is_interrupted_says_so_and_nothing_of_the_recording) {
  Program program({"measure", "roles", recording, "--rounds", "1000"});
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  program.signal(SIGINT);
  EXPECT_EQ(program.wait(), 130) << program.errors();
  EXPECT_EQ(program.errors().find(recording), std::string::npos) << program.errors();
}

TEST_F(MeasureRoles, stages_that_a_session_did_not_have_are_null) {
  const std::string one = folder.file("one");
  run(session({"--record", one, "--gather", "60", "--frames", "1"}));
  run({"measure", "roles", one, "--json", json});
  const nlohmann::json report = json_of(json);
  size_t none = 0;
  for (const auto& row : report.at("rows")) none += row.at("ms").is_null();
  EXPECT_GT(none, 0u);
  EXPECT_LT(none, 4u);
}

TEST_F(MeasureRoles, a_folder_without_a_role_is_one_line) {
  std::filesystem::remove(file(Role::switch_1));
  EXPECT_EQ(failure(measure()), "triptych: " + recording + ": holds no recording of switch node 1");
}

}  // namespace
}  // namespace triptych::test
