// Sessions that lose a role go on: every picture is right, and nobody and nothing is left behind.
#include "tests/session/recovery_rig.hpp"
#include "tests/session/relay.hpp"

namespace triptych::test {
namespace {

TEST_F(SessionRecovery, a_killed_switch_node_is_replaced) {
  for (const std::string role : {"switch 0", "switch 1"}) {
    SCOPED_TRACE(role);
    Program program(endless());
    wait_until_under_way(program);
    ::kill(program.role(role), SIGKILL);
    expect_recovery(program);
    const nlohmann::json report = json_of(json);
    EXPECT_EQ(report["restarts"], 1);
    EXPECT_EQ(report["restarted"][0]["role"], role);
    EXPECT_NE(report["restarted"][0]["reason"].get<std::string>().find("Killed"), std::string::npos);
    size_t alone = 0;
    for (const auto& fault : report["faults"]) alone += fault["frames_alone"].get<size_t>();
    EXPECT_EQ(alone, report["fallback_frames"]);
    ASSERT_FALSE(report["faults"].empty());
    const nlohmann::json& fault = report["faults"].front();
    EXPECT_NE(fault["reason"].get<std::string>().find("switch node"), std::string::npos) << fault;
    EXPECT_GT(fault["back_at_frame"].get<size_t>(), fault["frame"].get<size_t>());
  }
}

TEST_F(SessionRecovery, a_paused_switch_node_is_done_without_and_taken_back) {
  Program program(endless());
  wait_until_under_way(program);
  const pid_t paused = program.role("switch 1");
  ::kill(paused, SIGSTOP);
  wait_for(program, "goes on alone");
  ::kill(paused, SIGCONT);
  expect_recovery(program);
  EXPECT_EQ(json_of(json)["restarts"], 0);
}

TEST_F(SessionRecovery, a_killed_render_node_is_replaced_where_it_was) {
  const std::string pictures = folder.file("pictures");
  Program program(walk({"-o", pictures}));
  wait_until_under_way(program);
  ::kill(program.role("render"), SIGKILL);
  ASSERT_EQ(program.wait(), 0) << program.errors();
  EXPECT_FALSE(program.anybody_left());
  const nlohmann::json report = json_of(json);
  EXPECT_EQ(report["restarts"], 1);
  EXPECT_EQ(report["digest_mismatches"], 0);
  expect_right_pictures(report["pictures"]);
  size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(pictures)) {
    if (entry.path().filename() == ".triptych-run") continue;  // whose pictures these are
    ++files;
    EXPECT_EQ(entry.path().extension(), ".png") << entry.path() << " is a file half written";
  }
  EXPECT_EQ(files, rounds * frame_count);
}

TEST_F(SessionRecovery, flipped_bytes_are_noticed_and_never_shown) {
  Program program(endless({"--inject", "flipped-byte"}));
  expect_recovery(program);
}

TEST_F(SessionRecovery, a_role_that_dies_again_and_again_is_given_up) {
  Program program(endless({"--restarts", "1"}));
  wait_until_under_way(program);
  for (size_t kills = 0; kills < 2; ++kills) {
    wait_for(program, "role switch 0 is process ", kills + 1);
    ::kill(program.last_role("switch 0"), SIGKILL);
  }
  wait_for(program, "after 1 restarts; goes on without it");
  wait(std::chrono::milliseconds(200));
  program.signal(SIGTERM);
  ASSERT_EQ(program.wait(), 0) << program.errors();
  expect_only_right_pictures(json_of(json)["pictures"]);
}

/// Roles that are started by hand, the render node behind a relay.
class RelayedRoles : public SessionRecovery {
 protected:
  /// disturb: is given the relay and the second switch node, once all roles have met, or from the start.
  void play(const std::function<void(Relay&, const Program&)>& disturb,
            const std::vector<std::string>& more = {}, bool from_the_start = false) {
    const int port = 12000 + 2 * (::getpid() % 8000);
    const std::string listen = "127.0.0.1:" + std::to_string(port),
                      other = "127.0.0.1:" + std::to_string(port + 1);
    Relay relay(port);
    const std::string render = "127.0.0.1:" + std::to_string(relay.port());
    Program render_node(with({"role", "render", pack, "--path", path, "--size", "160x120", "--until-told",
                              "--rate", "100", "--hash", "--listen", listen, "--json", json},
                             more));
    Program switch_0(
        with({"role", "switch", pack, "--index", "0", "--listen", other, "--render", render, "--keep-trying"},
             more));
    Program switch_1(with(
        {"role", "switch", pack, "--index", "1", "--render", render, "--switch-0", other, "--keep-trying"},
        more));
    if (!from_the_start) {
      wait_for(render_node, "both switch nodes are here");
      wait(std::chrono::milliseconds(500));
    }
    disturb(relay, switch_1);
    wait_for(render_node, from_the_start ? "both switch nodes are here" : "both switch nodes are back");
    wait(std::chrono::milliseconds(200));
    render_node.signal(SIGTERM);
    EXPECT_EQ(render_node.wait(), 0) << render_node.errors();
    EXPECT_EQ(switch_0.wait(), 0) << switch_0.errors();
    EXPECT_EQ(switch_1.wait(), 0) << switch_1.errors();
    const nlohmann::json right = right_pictures();
    const nlohmann::json frames = json_of(json)["frames"];
    size_t wrong = 0, alone = 0;
    for (size_t i = 0; i < frames.size(); ++i) {
      const auto hash = frames[i]["picture_hash"].get<uint64_t>();
      wrong += hash != std::stoull(right[i % frame_count].get<std::string>(), nullptr, 16);
      alone += frames[i]["fallback"].get<bool>();
    }
    EXPECT_EQ(wrong, 0u);
    EXPECT_GE(alone, 1u);
    EXPECT_LT(alone, frames.size());
  }
};

TEST_F(RelayedRoles, that_are_cut_off_for_a_while_come_back) {
  play([](Relay& relay, const Program&) {
    relay.cut = true;
    wait(std::chrono::milliseconds(1200));
    relay.cut = false;
  });
}

TEST_F(RelayedRoles, go_on_after_a_byte_was_changed_on_the_way) {
  play([](Relay& relay, const Program&) { relay.flip_after = 500; });
}

TEST_F(RelayedRoles, wait_for_one_that_stays_away_for_longer_than_they_search) {
  // The searches of the two that are left end and begin at different times.
  play(
      [](Relay&, const Program& switch_1) {
        switch_1.signal(SIGSTOP);
        wait(std::chrono::milliseconds(3000));
        switch_1.signal(SIGCONT);
      },
      {"--connect-timeout", "1"});
}

TEST_F(RelayedRoles, begin_without_one_that_hangs_from_the_start) {
  play(
      [](Relay&, const Program& switch_1) {
        switch_1.signal(SIGSTOP);
        wait(std::chrono::milliseconds(2500));
        switch_1.signal(SIGCONT);
      },
      {"--connect-timeout", "1"}, true);
}

}  // namespace
}  // namespace triptych::test
