// What a switch node does, or leaves undone, never ends a session.
#include "tests/session/recovery_rig.hpp"

#include <optional>
#include <sys/resource.h>

namespace triptych::test {
namespace {

class SessionHangs : public SessionRecovery {
 protected:
  /// Searches end soon, so that seconds are for them what hours are otherwise.
  std::vector<std::string> short_searches(std::vector<std::string> more = {}) const {
    return with(walk({"--connect-timeout", "0.3"}), std::move(more));
  }
  static std::string command_name(pid_t pid) {
    std::string name = text_of("/proc/" + std::to_string(pid) + "/comm");
    return name.substr(0, name.find('\n'));
  }
};

TEST_F(SessionHangs, a_switch_node_may_hang_for_many_searches) {
  for (const std::string role : {"switch 0", "switch 1"}) {
    SCOPED_TRACE(role);
    Program program(with(session({"--until-told", "--rate", "150", "--hash", "--json", json}),
                         {"--connect-timeout", "0.3"}));
    wait_until_under_way(program);
    const pid_t hung = program.role(role);
    ::kill(hung, SIGSTOP);
    wait(std::chrono::milliseconds(3000));
    EXPECT_EQ(program.errors().find("starts it again"), std::string::npos) << program.errors();
    ::kill(hung, SIGCONT);
    wait_for(program, "both switch nodes are back");
    wait(std::chrono::milliseconds(200));
    program.signal(SIGTERM);
    ASSERT_EQ(program.wait(), 0) << program.errors();
    const nlohmann::json report = json_of(json);
    EXPECT_EQ(report["restarts"], 0);
    EXPECT_EQ(report["digest_mismatches"], 0);
    expect_only_right_pictures(report["pictures"]);
    // Who is missing is said, but not again with every search: two roles make ten each.
    const std::string said = program.errors(), words = "goes on looking";
    size_t lines = 0;
    for (size_t at = 0; (at = said.find(words, at)) != std::string::npos; ++at) ++lines;
    EXPECT_GE(lines, 1u) << said;
    EXPECT_LE(lines, 10u) << said;
  }
}

TEST_F(SessionHangs, a_switch_node_that_is_told_to_end_is_started_again) {
  Program program(endless());
  wait_until_under_way(program);
  ::kill(program.role("switch 1"), SIGTERM);
  expect_recovery(program);
  EXPECT_EQ(json_of(json)["restarts"], 1);
}

TEST_F(SessionHangs, a_pack_that_was_replaced_is_not_drawn_by_a_render_node_that_starts_again) {
  const std::string pictures = folder.file("pictures"), right = folder.file("right");
  run(session({"-o", right}));
  Program program(walk({"-o", pictures}));
  wait_until_under_way(program);
  scenes::write_pack("flat", folder.file("other.tpk"));
  std::filesystem::rename(folder.file("other.tpk"), pack);
  ::kill(program.role("render"), SIGKILL);
  EXPECT_EQ(program.wait(), 1) << program.errors();
  ASSERT_EQ(program.complaints().size(), 1u) << program.errors();
  EXPECT_NE(program.complaints()[0].find("room.tpk: is not the pack that the session began with"),
            std::string::npos)
      << program.complaints()[0];
  EXPECT_FALSE(program.anybody_left());
  size_t drawn = 0;
  for (const auto& entry : std::filesystem::directory_iterator(pictures)) {
    if (entry.path().extension() != ".png") continue;
    char name[32];
    std::snprintf(name, sizeof(name), "/%06zu.png", std::stoul(entry.path().stem().string()) % frame_count);
    EXPECT_EQ(text_of(entry.path()) == text_of(right + name), true) << entry.path();
    ++drawn;
  }
  EXPECT_GT(drawn, 0u);
}

TEST_F(SessionHangs, a_pack_that_was_replaced_is_not_drawn_by_a_switch_node_that_starts_again) {
  Program program(endless());
  wait_until_under_way(program);
  scenes::write_pack("flat", folder.file("other.tpk"));
  std::filesystem::copy_file(pack, folder.file("kept.tpk"));
  std::filesystem::rename(folder.file("other.tpk"), pack);
  ::kill(program.role("switch 0"), SIGKILL);
  wait_for(program, "room.tpk: is not the pack that the session began with");
  program.signal(SIGTERM);
  ASSERT_EQ(program.wait(), 0) << program.errors();
  std::filesystem::rename(folder.file("kept.tpk"), pack);
  expect_only_right_pictures(json_of(json)["pictures"]);
}

TEST_F(SessionHangs, a_path_that_was_replaced_changes_nothing_for_a_render_node_that_starts_again) {
  Program program(walk());
  wait_until_under_way(program);
  const std::string played = text_of(path);
  std::vector<View> backwards = scenes::path(scenes::pack("room").skeleton(), 160, 120);
  std::reverse(backwards.begin(), backwards.end());
  std::ofstream(path) << path_text(backwards);
  ::kill(program.role("render"), SIGKILL);
  ASSERT_EQ(program.wait(), 0) << program.errors();
  std::ofstream(path) << played;
  expect_right_pictures(json_of(json)["pictures"]);
}

TEST_F(SessionHangs, processes_are_named_after_their_roles) {
  Program program(walk());
  wait_until_under_way(program);
  EXPECT_EQ(command_name(program.role("render")), "triptych-render");
  EXPECT_EQ(command_name(program.role("switch 0")), "triptych-sw-0");
  EXPECT_EQ(command_name(program.role("switch 1")), "triptych-sw-1");
  program.signal(SIGTERM);
  program.wait();
}

TEST_F(SessionHangs, what_a_killed_session_leaves_behind_the_next_one_removes) {
  const std::string temporary = folder.file("tmp"),
                    before = std::getenv("TMPDIR") ? std::getenv("TMPDIR") : "";
  std::filesystem::create_directory(temporary);
  std::filesystem::create_directory(temporary + "/triptych-run-notours-at-all");
  ::setenv("TMPDIR", temporary.c_str(), 1);
  const auto entries = [&] {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(temporary))
      count += entry.path().filename().string().starts_with("triptych-run-");
    return count;
  };
  {
    Program living(walk({}, 10000)), killed(walk({}, 10000));
    wait_until_under_way(living);
    wait_until_under_way(killed);
    EXPECT_EQ(entries(), 3);
    killed.signal(SIGKILL);
    killed.wait();
    for (int tries = 0; tries < 600 && killed.anybody_left(); ++tries) wait(std::chrono::milliseconds(10));
    EXPECT_EQ(entries(), 3);
    run(session({"--frames", "2"}));
    EXPECT_EQ(entries(), 2) << "only the living one's, and what has another name";
    living.signal(SIGTERM);
    EXPECT_EQ(living.wait(), 128 + SIGTERM);
  }
  EXPECT_EQ(entries(), 1);
  before.empty() ? ::unsetenv("TMPDIR") : ::setenv("TMPDIR", before.c_str(), 1);
}

/// Lowers a limit of this process, for programs that it starts, while it lives.
class Limit {
 public:
  Limit(decltype(RLIMIT_AS) resource, rlim_t value) : resource_(resource) {
    ::getrlimit(resource_, &before_);
    const rlimit low{value, before_.rlim_max};
    ::setrlimit(resource_, &low);
  }
  ~Limit() { ::setrlimit(resource_, &before_); }
  Limit(const Limit&) = delete;
  Limit& operator=(const Limit&) = delete;

 private:
  decltype(RLIMIT_AS) resource_;
  rlimit before_{};
};

TEST_F(SessionHangs, low_limits_end_in_one_line_or_in_pictures) {
  const auto expect_an_end = [&](decltype(RLIMIT_AS) resource, rlim_t value) {
    SCOPED_TRACE(std::to_string(value));
    std::optional<Program> program;
    {
      const Limit limit(resource, value);
      program.emplace(session({"--frames", "2", "--gather", "0.5"}));
    }
    const int code = program->wait(std::chrono::seconds(60));
    constexpr int not_loaded = 127;  // by the system: not even the program's libraries fit
    if (code == 0 || code == not_loaded) return code;
    EXPECT_EQ(code, 1) << program->errors();
    EXPECT_EQ(program->complaints().size(), 1u) << program->errors();
    EXPECT_EQ(program->errors().find("terminate called"), std::string::npos) << program->errors();
    EXPECT_FALSE(program->anybody_left());
    return code;
  };
  int failed = 0;
  for (const rlim_t descriptors : {6, 8, 10, 12, 14})
    failed += expect_an_end(RLIMIT_NOFILE, descriptors) == 1;
  for (rlim_t mib = 76; mib < 116; mib += 4) failed += expect_an_end(RLIMIT_AS, mib << 20) == 1;
  EXPECT_GE(failed, 2) << "no limit was low enough";
}

TEST_F(SessionHangs, another_key_is_named_at_once_on_both_ends) {
  const auto key_file = [&](const std::string& name, char letter) {
    const std::string file = folder.file(name);
    std::ofstream(file) << std::string(64, letter);
    std::filesystem::permissions(file,
                                 std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
    return file;
  };
  const std::string key = key_file("key", 'k'), other_key = key_file("other", 'o');
  const int port = 12000 + 2 * (::getpid() % 8000);
  const std::string listen = "127.0.0.1:" + std::to_string(port),
                    next = "127.0.0.1:" + std::to_string(port + 1);
  Program render_node(
      {"role", "render", pack, "--path", path, "--listen", listen, "--key-file", key, "--gather", "30"});
  for (const std::vector<std::string>& flags :
       {std::vector<std::string>{"--key-file", other_key}, std::vector<std::string>{}}) {
    const auto start = std::chrono::steady_clock::now();
    const std::string line =
        failure(with({"role", "switch", pack, "--index", "1", "--render", listen, "--switch-0", next,
                      "--connect-timeout", flags.empty() ? "1" : "30"},
                     flags));
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10)) << line;
    EXPECT_NE(line.find("the render node at " + listen), std::string::npos) << line;
    EXPECT_TRUE(flags.empty() || line.find("is the key the same?") != std::string::npos) << line;
  }
  EXPECT_NE(render_node.errors().find("render node: a caller from 127.0.0.1: TLS: the handshake failed"),
            std::string::npos)
      << render_node.errors();
  render_node.signal(SIGTERM);
  EXPECT_EQ(render_node.wait(), 128 + SIGTERM);
}

}  // namespace
}  // namespace triptych::test
