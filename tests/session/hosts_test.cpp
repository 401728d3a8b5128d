// The file of a session's machines, and the line that starts a role on one of them.
#include "session/hosts.hpp"

#include "base/error.hpp"

#include <fstream>
#include <gtest/gtest.h>
#include <unistd.h>

namespace triptych {
namespace {

class HostsFile : public testing::Test {
 protected:
  ~HostsFile() override { std::filesystem::remove(file); }
  Hosts read(const std::string& text) const {
    std::ofstream(file) << text;
    return read_hosts(file, "scene.tpk");
  }
  std::string refusal(const std::string& text) const {
    try {
      read(text);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / ("triptych_hosts_" + std::to_string(::getpid()) + ".toml");
  const std::string roles = R"([render]
address = "10.0.0.1:7000"
[switch_0]
host = "b"
address = "10.0.0.2:7001"
[switch_1]
host = "c"
)";
};

TEST_F(HostsFile, says_who_plays_what_and_fills_in_the_rest) {
  const Hosts hosts =
      read("key_file = \"key\"\n" + roles + "pack = \"/data/other.tpk\"\nprogram = \"/opt/triptych\"\n");
  EXPECT_EQ(hosts.render, (Address{"10.0.0.1", 7000}));
  EXPECT_EQ(hosts.switch_0, (Address{"10.0.0.2", 7001}));
  EXPECT_EQ(hosts.key_file, "key");
  EXPECT_EQ(hosts.switch_nodes[0].name, "b");
  EXPECT_EQ(hosts.switch_nodes[0].pack, "scene.tpk");
  EXPECT_EQ(hosts.switch_nodes[0].program, "triptych");
  EXPECT_EQ(hosts.switch_nodes[0].key_file, "key");
  EXPECT_EQ(hosts.switch_nodes[1].pack, "/data/other.tpk");
  EXPECT_EQ(hosts.switch_nodes[1].program, "/opt/triptych");
  EXPECT_EQ(hosts.launch.find("ssh "), 0u);
}

TEST_F(HostsFile, names_what_is_wrong_with_it) {
  EXPECT_NE(refusal("").find("[render]: address is missing"), std::string::npos) << refusal("");
  EXPECT_NE(refusal("[render\n").find("line 1"), std::string::npos);
  EXPECT_NE(refusal("colour = \"red\"\n" + roles).find("colour is not known"), std::string::npos);
  EXPECT_NE(refusal(roles + "colour = \"red\"\n").find("[switch_1]: colour is not known"), std::string::npos);
  EXPECT_NE(refusal(roles + "[switch_2]\n").find("[switch_2] is not known"), std::string::npos);
  EXPECT_NE(refusal(roles + "pack = 3\n").find("pack must be a text in quotes"), std::string::npos);
  EXPECT_NE(refusal("launch = \"ssh b\"\n" + roles).find("launch must contain {host}"), std::string::npos);
  EXPECT_NE(refusal("launch = \"ssh {host} triptych\"\n" + roles).find("{command}"), std::string::npos);
}

TEST_F(HostsFile, that_is_a_folder_or_missing_is_named_with_the_reason) {
  const auto refused = [](const std::filesystem::path& path) -> std::string {
    try {
      read_hosts(path, "scene.tpk");
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refused(testing::TempDir()), testing::TempDir() + ": is a folder, not a file");
  EXPECT_EQ(refused("/nonexistent/hosts.toml"),
            "/nonexistent/hosts.toml: cannot be opened: No such file or directory");
}

/// What a shell makes of the line.
std::string answer_of(const std::string& line) {
  FILE* pipe = ::popen(line.c_str(), "r");
  std::string answer(1000, ' ');
  answer.resize(std::fread(answer.data(), 1, answer.size(), pipe));
  ::pclose(pipe);
  return answer;
}

TEST_F(HostsFile, words_reach_the_program_whole_through_one_shell_and_through_two) {
  const std::vector<std::string> words = {"%s|", "two words", "it's", "$HOME;`ls`", "", "a {command}"};
  const std::string expected = "two words|it's|$HOME;`ls`||a {command}|";
  for (const std::string launch : {"env HOST={host} {command}", "env HOST={host} sh -c {remote}"}) {
    Hosts hosts = read("launch = \"" + launch + "\"\nprogram = \"printf\"\n" + roles);
    EXPECT_EQ(answer_of(launch_line(hosts, hosts.switch_nodes[0], words)), expected) << launch;
  }
}

}  // namespace
}  // namespace triptych
