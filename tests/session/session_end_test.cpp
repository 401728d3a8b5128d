// How sessions end: bad input, busy ports, killed roles, signals. One clear line, exit 1, nobody and nothing
// left.
#include "tests/session/scene_files.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

namespace triptych::test {
namespace {

class SessionEnd : public SceneFiles {
 protected:
  /// Runs far longer than any test.
  std::vector<std::string> endless(std::vector<std::string> more = {}) const {
    return with(session({"--loop", "100000"}), std::move(more));
  }
  /// Until pictures appear: the session is under way.
  void wait_for_pictures(const Program& program) const {
    const std::string first = folder.file("pictures/000003.png");
    for (int tries = 0; tries < 6000 && !std::filesystem::exists(first); ++tries) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ASSERT_TRUE(std::filesystem::exists(first)) << program.errors();
  }
  /// Every file under its final name is whole: a PNG ends with its IEND chunk.
  void expect_whole_pictures() const {
    for (const auto& entry : std::filesystem::directory_iterator(folder.file("pictures"))) {
      if (entry.path().filename() == ".triptych-run") continue;  // whose folder it is
      EXPECT_EQ(entry.path().extension(), ".png") << entry.path() << " is a file half written";
      const std::string bytes = text_of(entry.path());
      ASSERT_GT(bytes.size(), 12u) << entry.path();
      EXPECT_EQ(bytes.substr(bytes.size() - 8, 4), "IEND") << entry.path();
    }
  }
};

TEST_F(SessionEnd, a_pack_that_is_missing) {
  const std::string line = failure({"session", folder.file("none.tpk"), "--path", path});
  EXPECT_NE(line.find("none.tpk"), std::string::npos) << line;
}

TEST_F(SessionEnd, a_pack_that_is_cut_in_half) {
  std::filesystem::resize_file(pack, std::filesystem::file_size(pack) / 2);
  const std::string line = failure(session());
  EXPECT_NE(line.find("room.tpk"), std::string::npos) << line;
}

TEST_F(SessionEnd, a_path_that_is_missing_or_without_frames) {
  EXPECT_NE(failure({"session", pack, "--path", folder.file("none.json")}).find("none.json"),
            std::string::npos);
  std::ofstream(path) << R"({"triptych_path": 1, "frames": []})";
  EXPECT_NE(failure(session()).find("no frames"), std::string::npos);
}

TEST_F(SessionEnd, an_empty_model_makes_no_pack) {
  const std::string model = folder.file("empty.obj");
  std::ofstream(model) << "# nothing\n";
  const size_t before = folder.files();
  failure({"build", model, "-o", folder.file("empty.tpk")});
  EXPECT_EQ(folder.files(), before) << "something was left behind";
}

TEST_F(SessionEnd, a_port_in_use) {
  const int listener = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(address);
  ASSERT_EQ(::bind(listener, reinterpret_cast<sockaddr*>(&address), size), 0);
  ASSERT_EQ(::listen(listener, 1), 0);
  ASSERT_EQ(::getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size), 0);
  const std::string port = std::to_string(ntohs(address.sin_port));
  const std::string line = failure(session({"--port", port}));
  EXPECT_NE(line.find(port), std::string::npos) << line;
  ::close(listener);
}

TEST_F(SessionEnd, a_signal_ends_every_role_in_good_order) {
  // To the session alone, and to all of its processes, as a terminal sends it.
  for (const auto& [signal, to_all] : {std::pair{SIGTERM, false}, {SIGINT, true}, {SIGHUP, true}}) {
    SCOPED_TRACE(signal);
    std::filesystem::remove_all(folder.file("pictures"));
    Program program(endless({"-o", folder.file("pictures"), "--json", json}));
    wait_for_pictures(program);
    ::kill(to_all ? -program.pid() : program.pid(), signal);
    EXPECT_EQ(program.wait(std::chrono::seconds(30)), 128 + signal) << program.errors();
    EXPECT_FALSE(program.anybody_left());
    EXPECT_TRUE(program.complaints().empty()) << program.errors();
    for (const char* done : {"of them by itself", "switch node 0: ", "switch node 1: "})
      EXPECT_NE(program.errors().find(done), std::string::npos) << "what it had done: " << program.errors();
    EXPECT_GE(json_of(json)["frames"], 4);
    expect_whole_pictures();
  }
}

TEST_F(SessionEnd, a_measurement_that_is_told_to_end_has_failed_and_leaves_nothing) {
  for (const int signal : {SIGTERM, SIGINT}) {
    const size_t before = folder.files();
    Program program(measure({"--loop", "100000"}));
    program.role("switch 1");
    program.signal(signal);
    EXPECT_EQ(program.wait(std::chrono::seconds(30)), 1) << program.errors();
    EXPECT_EQ(program.complaints(), std::vector<std::string>{"triptych: measure session: was told to end"});
    EXPECT_FALSE(program.anybody_left());
    EXPECT_EQ(folder.files(), before);
  }
}

TEST_F(SessionEnd, a_session_that_ignores_hangups_goes_on) {
  const auto before = ::signal(SIGHUP, SIG_IGN);  // as nohup does; programs that are started inherit it
  Program program(endless({"-o", folder.file("pictures"), "--json", json}));
  ::signal(SIGHUP, before);
  wait_for_pictures(program);
  ::kill(-program.pid(), SIGHUP);
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  EXPECT_EQ(program.errors().find("told to end"), std::string::npos) << program.errors();
  EXPECT_EQ(program.errors().find("by itself"), std::string::npos) << "it has ended: " << program.errors();
  program.signal(SIGTERM);
  EXPECT_EQ(program.wait(std::chrono::seconds(30)), 128 + SIGTERM) << program.errors();
}

TEST_F(SessionEnd, one_that_plays_until_it_is_told_has_done_what_it_should) {
  Program program(session({"--until-told", "-o", folder.file("pictures"), "--json", json}));
  wait_for_pictures(program);
  program.signal(SIGINT);
  EXPECT_EQ(program.wait(std::chrono::seconds(30)), 0) << program.errors();
  EXPECT_GE(json_of(json)["frames"], 4);
}

TEST_F(SessionEnd, a_render_node_that_is_told_to_end_ends_the_session_with_what_was_done) {
  Program program(endless({"-o", folder.file("pictures"), "--json", json}));
  wait_for_pictures(program);
  ::kill(program.role("render"), SIGTERM);
  EXPECT_EQ(program.wait(std::chrono::seconds(30)), 128 + SIGTERM) << program.errors();
  EXPECT_FALSE(program.anybody_left());
  EXPECT_GE(json_of(json)["frames"], 4);
}

TEST_F(SessionEnd, a_starter_that_is_killed_takes_its_roles_along) {
  Program program(endless({"-o", folder.file("pictures")}));
  wait_for_pictures(program);
  const std::vector<pid_t> roles = {program.role("render"), program.role("switch 0"),
                                    program.role("switch 1")};
  program.signal(SIGKILL);
  EXPECT_EQ(program.wait(std::chrono::seconds(30)), -SIGKILL);
  for (int tries = 0; tries < 600 && program.anybody_left(); ++tries)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_FALSE(program.anybody_left());
}

TEST_F(SessionEnd, a_role_that_was_started_from_elsewhere_ends_with_its_standard_input) {
  const std::string role = std::string(TRIPTYCH_PROGRAM) + " role switch " + pack +
                           " --index 1 --render 127.0.0.1:9 --switch-0 127.0.0.1:9 --connect-timeout 60";
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(std::system(("sleep 0.5 | " + role + " --end-with-stdin 2>/dev/null").c_str()), 0);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

TEST_F(SessionEnd, a_role_that_nobody_meets) {
  const std::string address = "127.0.0.1:" + std::to_string(12000 + 2 * (::getpid() % 8000));
  const std::string line = failure({"role", "switch", pack, "--index", "0", "--listen", address, "--render",
                                    "127.0.0.1:9", "--connect-timeout", "0.3"});
  EXPECT_NE(line.find("still without the render node"), std::string::npos) << line;
  // A render node needs nobody.
  Program render_node({"role", "render", pack, "--path", path, "--listen", address, "--json", json});
  EXPECT_EQ(render_node.wait(), 0) << render_node.errors();
  EXPECT_EQ(json_of(json)["frames"].size(), frame_count);
}

TEST_F(SessionEnd, roles_with_different_packs_do_not_play_together) {
  const std::string other_pack = folder.file("flat.tpk");
  scenes::write_pack("flat", other_pack);
  const int port = 12000 + 2 * (::getpid() % 8000);
  const std::string render = "127.0.0.1:" + std::to_string(port),
                    other = "127.0.0.1:" + std::to_string(port + 1);
  Program render_node({"role", "render", pack, "--path", path, "--listen", render, "--connect-timeout", "2",
                       "--gather", "4"});
  Program switch_0({"role", "switch", other_pack, "--index", "0", "--listen", other, "--render", render,
                    "--connect-timeout", "4"});
  Program switch_1({"role", "switch", pack, "--index", "1", "--render", render, "--switch-0", other,
                    "--connect-timeout", "4"});
  EXPECT_EQ(render_node.wait(), 0) << render_node.errors();
  EXPECT_NE(render_node.errors().find("pack differs"), std::string::npos) << render_node.errors();
  EXPECT_EQ(switch_0.wait(), 1) << switch_0.errors();
  EXPECT_EQ(switch_1.wait(), 1) << switch_1.errors();
  EXPECT_EQ(switch_0.complaints().size(), 1u);
}

}  // namespace
}  // namespace triptych::test
