// Folders under construction, and what killed processes leave of them.
#include "base/partial_folder.hpp"

#include <csignal>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace triptych {
namespace {

class Folders : public testing::Test {
 protected:
  Folders() {
    parent = std::filesystem::path(testing::TempDir()) /
             ("partial_folder_" + std::to_string(::getpid()) + "_" +
              testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(parent);
  }
  ~Folders() override { std::filesystem::remove_all(parent); }

  static void fill(const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder / "below");
    std::ofstream(folder / "below/file") << "content";
  }

  /// A process that holds such a folder, until it is killed.
  struct Holder {
    explicit Holder(const std::filesystem::path& path) {
      int ends[2] = {};
      EXPECT_EQ(::pipe(ends), 0);
      process = ::fork();
      if (process == 0) {
        const PartialFolder held(path);
        fill(held.path());
        if (::write(ends[1], "x", 1) != 1) std::_Exit(1);
        for (;;) ::pause();
      }
      char letter = 0;
      EXPECT_EQ(::read(ends[0], &letter, 1), 1);
      ::close(ends[0]);
      ::close(ends[1]);
      folder = path.string() + ".partial-" + std::to_string(process);
    }
    void kill() {
      if (process <= 0) return;
      ::kill(process, SIGKILL);
      ::waitpid(process, nullptr, 0);
      process = 0;
    }
    ~Holder() { kill(); }

    pid_t process = 0;
    std::filesystem::path folder;
  };

  std::filesystem::path parent;
};

TEST_F(Folders, are_gone_at_the_end_with_all_that_is_in_them) {
  {
    const PartialFolder folder(parent / "kit");
    EXPECT_TRUE(std::filesystem::is_directory(folder.path()));
    fill(folder.path());
  }
  EXPECT_TRUE(std::filesystem::is_empty(parent));
}

TEST_F(Folders, of_a_killed_process_are_removed_by_the_next_one) {
  Holder killed(parent / "kit");
  killed.kill();
  ASSERT_TRUE(std::filesystem::exists(killed.folder / "below/file"));
  const PartialFolder folder(parent / "kit");
  EXPECT_FALSE(std::filesystem::exists(killed.folder));
}

TEST_F(Folders, of_a_process_that_lives_and_those_of_other_names_stay) {
  const Holder lives(parent / "kit");
  for (const char* name : {"other.partial-1", "kit.partial-1x", "kit.partial-", "kit"}) fill(parent / name);
  std::ofstream(parent / "kit.partial-2") << "a file";
  { const PartialFolder folder(parent / "kit"); }
  EXPECT_TRUE(std::filesystem::exists(lives.folder / "below/file"));
  for (const char* name : {"other.partial-1", "kit.partial-1x", "kit.partial-", "kit"})
    EXPECT_TRUE(std::filesystem::exists(parent / name / "below/file")) << name;
  EXPECT_TRUE(std::filesystem::is_regular_file(parent / "kit.partial-2"));
}

TEST_F(Folders, that_a_link_stands_for_are_not_followed) {
  fill(parent / "precious");
  std::filesystem::create_directory_symlink(parent / "precious", parent / "kit.partial-3");
  { const PartialFolder folder(parent / "kit"); }
  EXPECT_TRUE(std::filesystem::exists(parent / "precious/below/file"));
}

}  // namespace
}  // namespace triptych
