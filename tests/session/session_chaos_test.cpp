// Faults at random, as many as one likes: no wrong picture, and no session that ends.
#include "tests/session/recovery_rig.hpp"

#include <cstdlib>
#include <random>

namespace triptych::test {
namespace {

int number_of(const char* variable, int otherwise) {
  const char* text = std::getenv(variable);
  return text ? std::atoi(text) : otherwise;
}

/// TRIPTYCH_CHAOS=200 makes a benchmark of it, with so many faults; TRIPTYCH_CHAOS_HANG=120 lets switch nodes
/// hang for up to so many seconds, TRIPTYCH_CHAOS_SEED=8 is another run.
class SessionChaos : public SessionRecovery {
 protected:
  static std::ptrdiff_t descriptors(pid_t pid) {
    const std::filesystem::path open = "/proc/" + std::to_string(pid) + "/fd";
    return std::distance(std::filesystem::directory_iterator(open), {});
  }
  /// A session without an end; its searches are short, so that a hang is longer than many of them.
  std::vector<std::string> enduring(std::vector<std::string> more = {}) const {
    return with(endless({"--restarts", "100000", "--connect-timeout", "0.4"}), std::move(more));
  }
  /// It is there to be told to end, and showed nothing wrong.
  nlohmann::json expect_a_good_end(Program& program) const {
    EXPECT_FALSE(std::filesystem::exists(json)) << "the session ended: " << program.errors();
    program.signal(SIGTERM);
    EXPECT_EQ(program.wait(std::chrono::seconds(60)), 0) << program.errors();
    EXPECT_FALSE(program.anybody_left());
    nlohmann::json report = json_of(json);
    EXPECT_EQ(report["digest_mismatches"], 0);
    expect_only_right_pictures(report["pictures"]);
    return report;
  }

  const bool benchmark = std::getenv("TRIPTYCH_CHAOS") != nullptr;
  const int faults = number_of("TRIPTYCH_CHAOS", 10);
  const int longest_hang_ms = 1000 * number_of("TRIPTYCH_CHAOS_HANG", 2);
};

TEST_F(SessionChaos, roles_killed_paused_and_hung_at_random_leave_nothing_wrong) {
  Program program(enduring());
  wait_until_under_way(program);
  const auto before = descriptors(program.pid());
  std::mt19937 random(static_cast<unsigned>(number_of("TRIPTYCH_CHAOS_SEED", 7)));
  const std::array<std::string, 3> roles = {"render", "switch 0", "switch 1"};
  int hangs = 0, done = 0;
  for (; done < faults && !std::filesystem::exists(json); ++done) {
    if (done % 3 == 1) {  // a switch node or both of them, for long
      const std::vector<pid_t> hung = {program.last_role(roles[1 + random() % 2]),
                                       program.last_role(roles[1 + random() % 2])};
      for (const pid_t pid : hung) ::kill(pid, SIGSTOP);
      const double share = 0.5 + static_cast<double>(random() % 1000) / 2000;
      wait(std::chrono::milliseconds(static_cast<int>(share * longest_hang_ms)));
      for (const pid_t pid : hung) ::kill(pid, SIGCONT);
      ++hangs;
    } else {
      const pid_t victim = program.last_role(roles[random() % roles.size()]);
      if (random() % 3 == 0) {
        ::kill(victim, SIGSTOP);
        wait(std::chrono::milliseconds(random() % 900));
        ::kill(victim, SIGCONT);
      } else {
        ::kill(victim, SIGKILL);
      }
    }
    wait(std::chrono::milliseconds(100 + random() % 700));
  }
  wait(std::chrono::milliseconds(700));
  EXPECT_LE(descriptors(program.pid()), before) << "descriptors leak";
  const nlohmann::json report = expect_a_good_end(program);
  if (benchmark) {
    std::printf(
        "%d faults, %d of them hangs of up to %d s, %zu restarts, %zu frames, %zu by the render node "
        "alone, longest frame %.0f ms\n",
        done, hangs, longest_hang_ms / 1000, report["restarts"].get<size_t>(), report["frames"].get<size_t>(),
        report["fallback_frames"].get<size_t>(), report["frame_ms"]["max"].get<double>());
  }
}

TEST_F(SessionChaos, sessions_begin_without_switch_nodes_and_take_them_in_whenever_they_come) {
  std::mt19937 random(11);
  for (int round = 0, sessions = std::max(3, faults / 10); round < sessions; ++round) {
    SCOPED_TRACE(round);
    std::filesystem::remove(json);
    std::filesystem::remove_all(folder.file("pictures"));
    Program program(enduring({"--gather", "0", "-o", folder.file("pictures")}));
    std::vector<pid_t> hung = {program.role(round % 2 ? "switch 0" : "switch 1")};
    if (round % 3 == 2) hung.push_back(program.role(round % 2 ? "switch 1" : "switch 0"));
    for (const pid_t pid : hung) ::kill(pid, SIGSTOP);
    for (int tries = 0; tries < 4000 && !std::filesystem::exists(folder.file("pictures/000003.png")); ++tries)
      wait(std::chrono::milliseconds(5));
    EXPECT_TRUE(std::filesystem::exists(folder.file("pictures/000003.png"))) << program.errors();
    EXPECT_EQ(program.errors().find("both switch nodes are here"), std::string::npos) << "it waited for them";
    wait(std::chrono::milliseconds(static_cast<int>(random() % 1000) * longest_hang_ms / 1000));
    for (const pid_t pid : hung) ::kill(pid, SIGCONT);
    wait_for(program, "both switch nodes are here");
    wait(std::chrono::milliseconds(300));
    const nlohmann::json report = expect_a_good_end(program);
    EXPECT_GT(report["fallback_frames"], 0);
    EXPECT_LT(report["fallback_frames"].get<size_t>(), report["frames"].get<size_t>());
  }
  if (benchmark) std::printf("all of these sessions began alone, and all three roles drew in the end\n");
}

}  // namespace
}  // namespace triptych::test
