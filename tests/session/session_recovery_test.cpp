// Sessions that lose a role go on: every picture is right, and nobody and nothing is left behind.
#include "tests/session/relay.hpp"
#include "tests/session/scene_files.hpp"

#include <cstdlib>
#include <random>

namespace triptych::test {
namespace {

class SessionRecovery : public SceneFiles {
 protected:
  static constexpr int rounds = 8;

  /// A few seconds long, with a hash of each picture.
  std::vector<std::string> walk(std::vector<std::string> more = {}, int loop = rounds) const {
    return with(session({"--loop", std::to_string(loop), "--rate", "150", "--hash", "--json", json}),
                std::move(more));
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
  /// The session ended well although it lost a switch node, and got it back.
  void expect_recovery(Program& program) const {
    ASSERT_EQ(program.wait(), 0) << program.errors();
    EXPECT_FALSE(program.anybody_left());
    EXPECT_NE(program.errors().find("both switch nodes are back"), std::string::npos) << program.errors();
    const nlohmann::json report = json_of(json);
    EXPECT_GE(report["fallback_frames"], 1);
    EXPECT_LT(report["fallback_frames"].get<size_t>(), report["frames"].get<size_t>());
    EXPECT_EQ(report["digest_mismatches"], 0);
    expect_right_pictures(report["pictures"]);
  }
  static void wait(std::chrono::milliseconds time) { std::this_thread::sleep_for(time); }
  /// Frames are being drawn: both switch nodes have culled.
  void wait_until_under_way(const Program& program) const {
    for (const char* role : {"render", "switch 0", "switch 1"}) ASSERT_GT(program.role(role), 0);
    for (int tries = 0; program.errors().find("both switch nodes are here") == std::string::npos; ++tries) {
      ASSERT_LT(tries, 3000) << program.errors();
      wait(std::chrono::milliseconds(10));
    }
    wait(std::chrono::milliseconds(500));
  }
};

TEST_F(SessionRecovery, a_killed_switch_node_is_replaced) {
  for (const std::string role : {"switch 0", "switch 1"}) {
    SCOPED_TRACE(role);
    Program program(walk());
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
  Program program(walk());
  wait_until_under_way(program);
  const pid_t paused = program.role("switch 1");
  ::kill(paused, SIGSTOP);
  wait(std::chrono::milliseconds(1500));
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
    ++files;
    EXPECT_EQ(entry.path().extension(), ".png") << entry.path() << " is a file half written";
  }
  EXPECT_EQ(files, rounds * frame_count);
}

TEST_F(SessionRecovery, flipped_bytes_are_noticed_and_never_shown) {
  Program program(walk({"--inject", "flipped-byte"}));
  expect_recovery(program);
}

TEST_F(SessionRecovery, a_role_that_dies_again_and_again_is_given_up) {
  Program program(walk({"--restarts", "1"}));
  wait_until_under_way(program);
  for (int kills = 0; kills < 2; ++kills) {
    const pid_t victim = program.last_role("switch 0");
    ::kill(victim, SIGKILL);
    wait(std::chrono::milliseconds(700));
  }
  ASSERT_EQ(program.wait(), 0) << program.errors();
  EXPECT_NE(program.errors().find("after 1 restarts; goes on without it"), std::string::npos)
      << program.errors();
  expect_right_pictures(json_of(json)["pictures"]);
}

/// Roles that are started by hand, the render node behind a relay.
class RelayedRoles : public SessionRecovery {
 protected:
  /// disturb: is given the relay and the second switch node.
  void play(const std::function<void(Relay&, const Program&)>& disturb,
            const std::vector<std::string>& more = {},
            std::chrono::milliseconds after = std::chrono::milliseconds(1200)) {
    const int port = 12000 + 2 * (::getpid() % 8000);
    const std::string listen = "127.0.0.1:" + std::to_string(port),
                      other = "127.0.0.1:" + std::to_string(port + 1);
    Relay relay(port);
    const std::string render = "127.0.0.1:" + std::to_string(relay.port());
    Program render_node(
        with({"role", "render", pack, "--path", path, "--size", "160x120", "--loop", std::to_string(rounds),
              "--rate", "100", "--hash", "--listen", listen, "--json", json},
             more));
    Program switch_0(
        with({"role", "switch", pack, "--index", "0", "--listen", other, "--render", render}, more));
    Program switch_1(
        with({"role", "switch", pack, "--index", "1", "--render", render, "--switch-0", other}, more));
    wait(after);
    disturb(relay, switch_1);
    EXPECT_EQ(render_node.wait(), 0) << render_node.errors();
    EXPECT_EQ(switch_0.wait(), 0) << switch_0.errors();
    EXPECT_EQ(switch_1.wait(), 0) << switch_1.errors();
    EXPECT_NE(render_node.errors().find("both switch nodes are back"), std::string::npos)
        << render_node.errors();
    nlohmann::json pictures = nlohmann::json::array();
    const nlohmann::json right = right_pictures();
    const nlohmann::json frames = json_of(json)["frames"];
    ASSERT_EQ(frames.size(), rounds * frame_count);
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
      {"--connect-timeout", "1", "--keep-trying"});
}

TEST_F(RelayedRoles, that_keep_trying_begin_without_one_that_hangs_from_the_start) {
  play(
      [](Relay&, const Program& switch_1) {
        switch_1.signal(SIGSTOP);
        wait(std::chrono::milliseconds(2500));
        switch_1.signal(SIGCONT);
      },
      {"--connect-timeout", "1", "--keep-trying"}, std::chrono::milliseconds(0));
}

TEST_F(SessionRecovery, roles_killed_and_paused_at_random_leave_nothing_wrong) {
  // TRIPTYCH_CHAOS=200 makes a benchmark of it.
  const char* wanted = std::getenv("TRIPTYCH_CHAOS");
  const int faults = wanted ? std::atoi(wanted) : 8;
  const int loop = 10 + faults * 3;
  Program program(walk({"--restarts", "100000"}, loop));
  wait_until_under_way(program);
  const auto descriptors = [](pid_t pid) {
    const std::filesystem::path open = "/proc/" + std::to_string(pid) + "/fd";
    return std::distance(std::filesystem::directory_iterator(open), {});
  };
  const auto before = descriptors(program.pid());
  std::mt19937 random(7);
  const std::array<std::string, 3> roles = {"render", "switch 0", "switch 1"};
  int done = 0;
  for (; done < faults; ++done) {
    const pid_t victim = program.last_role(roles[random() % roles.size()]);
    if (random() % 4 == 0) {
      ::kill(victim, SIGSTOP);
      wait(std::chrono::milliseconds(random() % 900));
      ::kill(victim, SIGCONT);
    } else {
      ::kill(victim, SIGKILL);
    }
    wait(std::chrono::milliseconds(100 + random() % 700));
    if (std::filesystem::exists(json)) break;  // the session is over
  }
  EXPECT_GE(done, faults / 2) << "the session was too short";
  wait(std::chrono::milliseconds(700));
  if (!std::filesystem::exists(json)) {
    EXPECT_LE(descriptors(program.pid()), before) << "descriptors leak";
  }
  ASSERT_EQ(program.wait(std::chrono::seconds(60 + faults * 10)), 0) << program.errors();
  EXPECT_FALSE(program.anybody_left());
  const nlohmann::json report = json_of(json);
  EXPECT_EQ(report["digest_mismatches"], 0);
  expect_right_pictures(report["pictures"], static_cast<size_t>(loop));
  if (wanted) {
    std::printf("%d faults, %zu restarts, %zu frames, %zu by the render node alone, longest frame %.0f ms\n",
                done, report["restarts"].get<size_t>(), report["frames"].get<size_t>(),
                report["fallback_frames"].get<size_t>(), report["frame_ms"]["max"].get<double>());
  }
}

}  // namespace
}  // namespace triptych::test
