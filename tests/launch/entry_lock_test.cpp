// A second process that wants a pack which another one builds: it waits, says for whom, and goes on.
#include "tests/launch/model_files.hpp"

namespace triptych::test {
namespace {

class WaitingForAPack : public ModelFiles {
 protected:
  /// Of a model that takes a while to build.
  WaitingForAPack() {
    run({"sample", "plant", "-o", folder.file("plant"), "--triangles", "200000"});
    words = {"info", folder.file("plant/scene.gltf")};
  }

  /// The process that builds the pack, once it has begun, and its parent; both are stopped then.
  std::vector<pid_t> stop_while_it_builds(const Program& first) const {
    std::vector<pid_t> builders;
    for (int tries = 0; tries < 60'000 && builders.size() < 2; ++tries) {
      std::error_code none;
      for (const auto& entry : std::filesystem::directory_iterator(folder.file("cache"), none)) {
        std::istringstream numbers(text_of(entry.path() / "lock"));
        builders.clear();
        for (pid_t process = 0; numbers >> process;) builders.push_back(process);
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_EQ(builders.size(), 2u) << first.errors();
    for (const pid_t process : builders) ::kill(process, SIGSTOP);
    return builders;
  }
  static void wait_for(const Program& program, const std::string& said) {
    for (int tries = 0; program.errors().find(said) == std::string::npos; ++tries) {
      ASSERT_LT(tries, 6000) << "not said: " << said << "\n" << program.errors();
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }

  std::vector<std::string> words;
};

TEST_F(WaitingForAPack, waits_for_a_process_that_is_stopped_and_names_it) {
  Program first(words);
  const std::vector<pid_t> builders = stop_while_it_builds(first);
  ASSERT_EQ(builders.size(), 2u);
  EXPECT_EQ(builders[0], first.pid());
  Program second(words), given_up(words);
  const std::string both = std::to_string(builders[0]) + " " + std::to_string(builders[1]);
  for (const Program* waiting : {&second, &given_up})
    wait_for(*waiting,
             "processes " + both + ", which build this pack, are stopped; waiting (kill -CONT " + both);
  given_up.signal(SIGTERM);
  EXPECT_EQ(given_up.wait(), -SIGTERM);
  for (const pid_t process : builders) ::kill(process, SIGCONT);
  EXPECT_EQ(first.wait(), 0) << first.errors();
  EXPECT_EQ(second.wait(), 0) << second.errors();
  EXPECT_EQ(second.errors().find("building a pack"), std::string::npos) << second.errors();
}

TEST_F(WaitingForAPack, is_never_refused_one_whose_builders_were_killed) {
  Program first(words);
  const std::vector<pid_t> builders = stop_while_it_builds(first);
  ASSERT_EQ(builders.size(), 2u);
  first.signal(SIGKILL);
  first.wait();
  // What it began may live on for a while, or not.
  Program second(words);
  ::kill(builders[1], SIGKILL);
  EXPECT_EQ(second.wait(), 0) << second.errors();
  EXPECT_NE(second.errors().find("building a pack"), std::string::npos) << second.errors();
}

}  // namespace
}  // namespace triptych::test
