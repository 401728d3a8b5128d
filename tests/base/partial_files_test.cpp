// Files half written: those of processes that are gone go, too, and nothing else does.
#include "base/partial_files.hpp"

#include "base/file.hpp"

#include <csignal>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace triptych {
namespace {

namespace fs = std::filesystem;

class PartialFiles : public testing::Test {
 protected:
  PartialFiles()
      : folder(fs::path(testing::TempDir()) /
               ("triptych_partial_" + std::to_string(::getpid()) + "_" +
                testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  ~PartialFiles() override { fs::remove_all(folder); }

  /// A process begins the file and is killed.
  void leave_half(const std::string& name) const {
    const pid_t child = ::fork();
    if (child == 0) {
      AtomicFile file(folder / name);
      file.write("half");
      ::raise(SIGKILL);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
    ASSERT_TRUE(fs::exists(folder / (name + ".partial-" + std::to_string(child))));
  }
  size_t files() const {
    return static_cast<size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
  }

  fs::path folder;
};

TEST_F(PartialFiles, of_a_process_that_is_gone_are_removed_by_the_next_one_that_writes_there) {
  leave_half("a.png");
  leave_half("b.png");
  ASSERT_EQ(files(), 1u) << "its process is the next one for what the first left";
  AtomicFile next(folder / "c.png");
  EXPECT_EQ(files(), 1u) << "the one under construction";
  next.commit();
  EXPECT_TRUE(fs::exists(folder / "c.png"));
}

TEST_F(PartialFiles, of_a_living_process_stay_until_they_have_their_name) {
  AtomicFile living(folder / "a.png");
  living.write("whole");
  remove_forsaken_partial_files(folder);
  EXPECT_EQ(files(), 1u);
  living.commit();
  EXPECT_EQ(read_text_file(folder / "a.png"), "whole");
}

TEST_F(PartialFiles, are_files_of_that_name_and_nothing_else) {
  for (const char* name : {"a.partial-", "a.partial-12x", "a.partial", "partial-12"})
    std::ofstream(folder / name) << "somebody's";
  fs::create_directory(folder / "b.partial-12");
  fs::create_symlink(folder / "a.partial", folder / "c.partial-12");
  remove_forsaken_partial_files(folder);
  EXPECT_EQ(files(), 6u);
  std::ofstream(folder / "d.partial-12") << "half";
  remove_forsaken_partial_files(folder);
  EXPECT_EQ(files(), 6u);
}

}  // namespace
}  // namespace triptych
