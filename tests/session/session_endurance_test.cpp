// Sessions that strangers call, that have a slow role, and that last: the pictures stay right and the memory
// flat.
#include "tests/session/scene_files.hpp"

#include <arpa/inet.h>
#include <atomic>
#include <cstdlib>
#include <map>
#include <netinet/in.h>
#include <sys/resource.h>
#include <sys/socket.h>

namespace triptych::test {
namespace {

class SessionEndurance : public SceneFiles {
 protected:
  static void wait(std::chrono::milliseconds time) { std::this_thread::sleep_for(time); }

  static int call(int port) {
    const int caller = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<uint16_t>(port));
    if (::connect(caller, reinterpret_cast<sockaddr*>(&address), sizeof(address)) != 0 &&
        errno != EINPROGRESS) {
      ::close(caller);
      return -1;
    }
    return caller;
  }

  /// A thousand callers at the port who say nothing, too much, or one byte now and then, until `stop`.
  static void besiege(int port, const std::atomic<bool>& stop) {
    rlimit limit{};
    ::getrlimit(RLIMIT_NOFILE, &limit);
    limit.rlim_cur = limit.rlim_max;
    ::setrlimit(RLIMIT_NOFILE, &limit);
    std::vector<int> callers;
    for (int i = 0; i < 1000; ++i) callers.push_back(call(port));
    const std::string garbage(4096, '\x5a');
    const std::string promise("TRI\5\0\0\0\0\377\377\377\003\0\0\0\0", 16);
    while (!stop) {
      for (size_t i = 0; i < callers.size(); ++i) {
        const std::string& words = i % 3 == 0 ? garbage : promise;
        const size_t length = i % 3 == 0 ? garbage.size() : i % 3 == 1 ? 1 : 0;
        if (callers[i] >= 0 && length > 0 && ::send(callers[i], words.data(), length, MSG_NOSIGNAL) < 0 &&
            errno != EAGAIN && errno != ENOTCONN) {
          ::close(callers[i]);
          callers[i] = call(port);
        }
      }
      wait(std::chrono::milliseconds(20));
    }
    for (const int caller : callers) {
      if (caller >= 0) ::close(caller);
    }
  }

  /// A session under siege loses a switch node and gets it back.
  void expect_to_stand_a_siege(std::vector<std::string> more) {
    run(session({"--hash", "--json", json, "--timeout", "60000"}));
    const nlohmann::json right = json_of(json)["pictures"];
    const int port = 12000 + 2 * (::getpid() % 8000);
    std::atomic<bool> stop{false};
    std::thread strangers([&] { besiege(port, stop); });
    Program program(with(session({"--hash", "--json", json, "--port", std::to_string(port), "--loop", "10",
                                  "--rate", "100", "-o", folder.file("pictures")}),
                         std::move(more)));
    for (int tries = 0; tries < 4000 && !std::filesystem::exists(folder.file("pictures/000009.png")); ++tries)
      wait(std::chrono::milliseconds(5));
    ::kill(program.role("switch 1"), SIGKILL);
    const int code = program.wait(std::chrono::seconds(120));
    stop = true;
    strangers.join();
    ASSERT_EQ(code, 0) << program.errors();
    EXPECT_NE(program.errors().find("both switch nodes are back"), std::string::npos) << program.errors();
    const nlohmann::json report = json_of(json);
    ASSERT_EQ(report["frames"], 10 * frame_count);
    for (size_t i = 0; i < report["pictures"].size(); ++i)
      ASSERT_EQ(report["pictures"][i], right[i % frame_count]) << "frame " << i;
  }

  static size_t resident_bytes(pid_t pid) {
    std::ifstream in("/proc/" + std::to_string(pid) + "/statm");
    size_t pages = 0;
    in >> pages >> pages;
    return pages * static_cast<size_t>(::sysconf(_SC_PAGESIZE));
  }
};

TEST_F(SessionEndurance, strangers_at_the_door_do_not_disturb) { expect_to_stand_a_siege({}); }

TEST_F(SessionEndurance, strangers_without_the_key_do_not_disturb) {
  const std::string key = folder.file("key");
  std::ofstream(key) << std::string(64, 'k');
  std::filesystem::permissions(key, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  expect_to_stand_a_siege({"--key-file", key});
}

TEST_F(SessionEndurance, other_machines_need_a_key_or_an_explicit_word) {
  const std::string line = failure({"role", "render", pack, "--path", path, "--listen", "0.0.0.0:0"});
  EXPECT_NE(line.find("give --key-file FILE, or --insecure"), std::string::npos) << line;
  Program insecure(
      {"role", "render", pack, "--path", path, "--listen", "0.0.0.0:0", "--insecure", "--frames", "1"});
  EXPECT_EQ(insecure.wait(), 0);
  EXPECT_NE(insecure.errors().find("not encrypted"), std::string::npos) << insecure.errors();
}

TEST_F(SessionEndurance, memory_stays_flat_while_roles_are_slow) {
  // TRIPTYCH_SOAK=3600 makes an hour of it.
  const char* wanted = std::getenv("TRIPTYCH_SOAK");
  const int seconds = wanted ? std::atoi(wanted) : 20;
  Program program(session({"--loop", "1000000", "--timeout", "60000", "--json", json}));
  const std::vector<std::string> names = {"render", "switch 0", "switch 1"};
  for (const std::string& name : names) ASSERT_GT(program.role(name), 0);
  const auto sizes = [&] {
    std::map<std::string, size_t> bytes = {{"session", resident_bytes(program.pid())}};
    for (const std::string& name : names) bytes[name] = resident_bytes(program.role(name));
    return bytes;
  };
  wait(std::chrono::milliseconds(4000));
  const auto before = sizes();
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(seconds);
  for (size_t turn = 0; std::chrono::steady_clock::now() < end; ++turn) {
    const pid_t slow = program.role(names[turn % names.size()]);
    ::kill(slow, SIGSTOP);
    wait(std::chrono::milliseconds(150));
    ::kill(slow, SIGCONT);
    wait(std::chrono::milliseconds(350));
  }
  constexpr size_t slack = 6 << 20;
  for (const auto& [name, bytes] : sizes()) {
    EXPECT_LT(bytes, before.at(name) + slack) << name << " grew from " << before.at(name);
    if (wanted) std::printf("%s: %zu KiB, then %zu KiB\n", name.c_str(), before.at(name) >> 10, bytes >> 10);
  }
  program.signal(SIGTERM);
  EXPECT_EQ(program.wait(std::chrono::seconds(60)), 128 + SIGTERM) << program.errors();
  EXPECT_EQ(json_of(json)["digest_mismatches"], 0);
}

/// A session with a slow role, whose sets change much and go out in small packets.
class SlowRole : public SessionEndurance, public testing::WithParamInterface<const char*> {};

TEST_P(SlowRole, makes_no_queue_longer_and_changes_no_picture) {
  run(session({"--hash", "--json", json, "--timeout", "60000"}));
  const nlohmann::json right = json_of(json)["pictures"];
  const auto play = [&](int loop) {
    Program program(session({"--hash", "--json", json, "--timeout", "60000", "--batch", "1", "--loop",
                             std::to_string(loop), "--inject", GetParam()}));
    EXPECT_EQ(program.wait(), 0) << program.errors();
    const nlohmann::json report = json_of(json);
    EXPECT_EQ(report["fallback_frames"], 0);
    EXPECT_EQ(report["pictures"].size(), static_cast<size_t>(loop) * frame_count);
    for (size_t i = 0; i < report["pictures"].size(); ++i)
      EXPECT_EQ(report["pictures"][i], right[i % frame_count]) << "frame " << i;
    return report["most_waiting"];
  };
  // What two frames of this path can bring, at most: 60 messages, 8 kB. Four times as long, no more of it.
  for (const int loop : {1, 4}) {
    const nlohmann::json most = play(loop);
    for (const char* role : {"render node", "switch node 0", "switch node 1"}) {
      EXPECT_GT(most[role]["messages"].get<size_t>(), 0u) << most;
      EXPECT_LE(most[role]["messages"].get<size_t>(), 60u) << role << most;
      EXPECT_LE(most[role]["bytes"].get<size_t>(), 8'000u) << role << most;
    }
    if (std::getenv("TRIPTYCH_SOAK"))
      std::printf("%s, %d times: %s\n", GetParam(), loop, most.dump().c_str());
  }
}

TEST_P(SlowRole, lets_the_memory_of_the_fast_ones_be_flat) {
  Program program(
      session({"--loop", "1000000", "--timeout", "60000", "--batch", "1", "--inject", GetParam()}));
  const std::vector<std::string> names = {"render", "switch 0", "switch 1"};
  for (const std::string& name : names) ASSERT_GT(program.role(name), 0);
  wait(std::chrono::milliseconds(4000));
  std::map<std::string, size_t> before;
  for (const std::string& name : names) before[name] = resident_bytes(program.role(name));
  wait(std::chrono::milliseconds(8000));
  for (const std::string& name : names)
    EXPECT_LT(resident_bytes(program.role(name)), before[name] + (4 << 20))
        << name << " grew from " << before[name];
  program.signal(SIGTERM);
  EXPECT_EQ(program.wait(std::chrono::seconds(60)), 128 + SIGTERM) << program.errors();
}

INSTANTIATE_TEST_SUITE_P(Of, SlowRole, testing::Values("slow-render-node", "slow-switch-node"));

}  // namespace
}  // namespace triptych::test
