// What happens to a command whose standard streams are closed or full, and to one that a signal ends.
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace triptych {
namespace {

class Streams : public testing::Test {
 protected:
  Streams()
      : folder(std::filesystem::path(testing::TempDir()) /
               ("triptych_streams_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "one.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  }
  ~Streams() override { std::filesystem::remove_all(folder); }

  /// The exit code of what a shell makes of the lines, in the folder; $triptych is the program.
  int run(const std::string& lines) const {
    const std::string whole = "cd '" + folder.string() + "'; triptych='" TRIPTYCH_PROGRAM "'\n" + lines;
    const int status = std::system(whole.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string text(const std::string& name) const {
    std::ifstream file(folder / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  std::filesystem::path folder;
};

TEST_F(Streams, that_are_full_end_a_command_with_one_line) {
  ASSERT_EQ(run("$triptych build one.obj -o one.tpk 2>/dev/null"), 0);
  EXPECT_EQ(run("$triptych info one.tpk >/dev/full 2>line"), 1);
  EXPECT_EQ(text("line"), "triptych: standard output: No space left on device\n");
  EXPECT_EQ(run("$triptych info missing.tpk 2>/dev/full"), 1);
}

TEST_F(Streams, that_are_closed_leave_files_as_they_should_be) {
  ASSERT_EQ(run("$triptych build one.obj -o one.tpk 2>/dev/null"), 0);
  for (const std::string closed : {"<&-", ">&-", "2>&-", "<&- >&- 2>&-"}) {
    EXPECT_EQ(
        run("$triptych build one.obj -o other.tpk " + (closed == ">&-" ? closed + " 2>/dev/null" : closed) +
            (closed == "<&-" ? " 2>/dev/null" : "")),
        0)
        << closed;
    EXPECT_EQ(text("other.tpk"), text("one.tpk")) << closed;
    std::filesystem::remove(folder / "other.tpk");
  }
}

TEST_F(Streams, a_file_larger_than_a_user_may_have_is_one_line_and_is_gone) {
  EXPECT_EQ(run("ulimit -f 8; $triptych sample plant --triangles 50000 -o plant >/dev/null 2>line"), 1);
  EXPECT_NE(text("line").find("triptych: plant/scene.bin: cannot be written: File too large\n"),
            std::string::npos)
      << text("line");
  EXPECT_TRUE(std::filesystem::is_empty(folder / "plant"));
}

TEST_F(Streams, temporary_files_want_a_folder) {
  EXPECT_EQ(run("TMPDIR=none $triptych measure build one.obj 2>line"), 1);
  EXPECT_EQ(text("line"),
            "triptych: TMPDIR: names no folder for temporary files: No such file or directory\n");
}

TEST_F(Streams, a_command_that_is_terminated_takes_its_unfinished_files_along) {
  // A plant has its unfinished file from the first moment on, for seconds. 3: it was over before anything
  // could be seen; 4: something stayed.
  EXPECT_EQ(run(R"($triptych sample plant -o plant >/dev/null 2>&1 & pid=$!
                   for i in $(seq 1000); do ls plant 2>/dev/null | grep -q partial && break; sleep 0.02; done
                   ls plant | grep -q partial || { kill $pid; exit 3; }
                   kill -TERM $pid; wait $pid; code=$?
                   ls plant | grep -q partial && exit 4
                   exit $code)"),
            128 + SIGTERM);
}

}  // namespace
}  // namespace triptych
