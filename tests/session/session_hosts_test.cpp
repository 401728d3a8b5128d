// Sessions over several machines as ssh starts them: a program of that name stands in for it, which does to
// words what ssh does.
#include "tests/session/hosts_file.hpp"
#include "tests/session/scene_files.hpp"

namespace triptych::test {
namespace {

class SessionHosts : public SceneFiles {
 protected:
  SessionHosts() {
    // Options, then the host; what follows is joined by spaces and goes to a shell beyond, out of a
    // terminal's reach.
    const std::string ssh = folder.file("ssh");
    std::ofstream(ssh)
        << "#!/bin/sh\n"
           "while [ \"$1\" = -o ]; do shift 2; done\n"
           "if [ \"$1\" = nowhere ]; then echo 'ssh: no route to host nowhere' >&2; exit 255; fi\n"
           "echo \"$1\" >> \"" +
               folder.file("called") +
               "\"\n"
               "shift\n"
               "setsid -w sh -c \"$*\" 2>&1 | cat\n";
    std::filesystem::permissions(ssh, std::filesystem::perms::owner_all);
    ::setenv("PATH", (std::filesystem::path(ssh).parent_path().string() + ":" + path_before).c_str(), 1);
  }
  ~SessionHosts() override { ::setenv("PATH", path_before.c_str(), 1); }

  const std::string path_before = std::getenv("PATH") ? std::getenv("PATH") : "";
};

TEST_F(SessionHosts, names_with_spaces_and_quotes_reach_the_other_machines_whole) {
  run(session({"--hash", "--json", json, "--timeout", "60000"}));
  const nlohmann::json right = json_of(json)["pictures"];
  const std::string odd = folder.file("it's $HOME's \"room\" & more.tpk"), key = folder.file("a key; it's");
  std::filesystem::rename(pack, odd);
  std::ofstream(key) << std::string(64, 'k');
  std::filesystem::permissions(key, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  const std::string hosts = write_hosts_file(folder.file("hosts.toml"), {.key_file = key});
  Program program({"session", odd, "--path", path, "--size", "160x120", "--gather", "60", "--hosts", hosts,
                   "--hash", "--json", json, "--timeout", "60000"});
  ASSERT_EQ(program.wait(), 0) << program.errors();
  EXPECT_FALSE(program.anybody_left());
  const nlohmann::json report = json_of(json);
  EXPECT_EQ(report["pictures"], right);
  EXPECT_EQ(report["fallback_frames"], 0) << program.errors();
  EXPECT_EQ(text_of(folder.file("called")).size(), std::string("b\nc\n").size()) << "each is called once";
}

TEST_F(SessionHosts, a_machine_that_cannot_be_reached_is_done_without_and_named_with_what_ssh_said) {
  const std::string hosts = write_hosts_file(folder.file("hosts.toml"), {.second = "nowhere"});
  Program program(session({"--hosts", hosts, "--gather", "0", "--rate", "20", "--json", json}));
  EXPECT_EQ(program.wait(std::chrono::seconds(60)), 0) << program.errors();
  EXPECT_NE(program.errors().find("switch 1 on nowhere (process "), std::string::npos) << program.errors();
  EXPECT_NE(program.errors().find("no route to host nowhere"), std::string::npos) << program.errors();
  EXPECT_FALSE(program.anybody_left());
  const nlohmann::json report = json_of(json);
  EXPECT_EQ(report["fallback_frames"], frame_count);
  EXPECT_GE(report["restarts"].get<int>(), 1) << "it is tried again";
}

TEST_F(SessionHosts, ctrl_c_lets_the_other_machines_say_what_they_had_done) {
  const std::string hosts = write_hosts_file(folder.file("hosts.toml"));
  Program program(session({"--hosts", hosts, "--loop", "100000", "-o", folder.file("pictures")}));
  for (int tries = 0; tries < 6000 && !std::filesystem::exists(folder.file("pictures/000009.png")); ++tries)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  ::kill(-program.pid(), SIGINT);  // as a terminal does: to all that are on it
  ASSERT_EQ(program.wait(std::chrono::seconds(30)), 128 + SIGINT) << program.errors();
  for (const char* role : {"switch 0 on b: switch node 0: ", "switch 1 on c: switch node 1: "})
    EXPECT_NE(program.errors().find(role), std::string::npos) << program.errors();
  EXPECT_FALSE(program.anybody_left());
}

}  // namespace
}  // namespace triptych::test
