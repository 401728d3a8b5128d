// A machine that gives few processes: one line, or what was asked for, and never a crash or a hang.
#include "tests/launch/model_files.hpp"

#include <array>

namespace triptych::test {
namespace {

class LowLimits : public ModelFiles {
 protected:
  struct Ended {
    int code = -1;
    std::string said;
  };

  /// Run by a user who owns nothing else: limits of processes count all that a user has, and root has none.
  Ended run_limited(const std::string& words, int processes) const {
    static int users = 0;
    const std::string user = std::to_string(200'000 + 100 * (::getpid() % 30'000) + users++ % 100);
    const std::string limit = processes > 0 ? "ulimit -u " + std::to_string(processes) + "; " : "";
    const std::string line = "cd '" + folder.file("out") + "' && setpriv --reuid " + user + " --regid " +
                             user + " --clear-groups timeout 100 bash -c '" + limit +
                             "exec " TRIPTYCH_PROGRAM " " + words + "' 2>&1 >/dev/null";
    FILE* const pipe = ::popen(line.c_str(), "r");
    Ended ended;
    std::array<char, 4096> part{};
    for (size_t count; (count = std::fread(part.data(), 1, part.size(), pipe)) > 0;)
      ended.said.append(part.data(), count);
    ended.code = WEXITSTATUS(::pclose(pipe));
    return ended;
  }
};

TEST_F(LowLimits, of_processes_end_in_one_line_or_in_what_was_asked_for) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can run programs as a user who has no other processes";
  std::filesystem::create_directory(folder.file("out"));
  std::filesystem::permissions(folder.file("out"), std::filesystem::perms::all);
  run({"build", model, "-o", folder.file("box.tpk")});
  run({"sample", "kit", "-o", folder.file("kit")});
  if (const Ended able = run_limited("info " + folder.file("box.tpk"), 0); able.code != 0)
    GTEST_SKIP() << "another user cannot run the program: " << able.said;
  const std::string shown = folder.file("box.tpk") + " --path " + path + " --size 64x64 --device cpu";
  int failed = 0;
  for (const int processes : {1, 2, 4, 6, 9}) {
    for (const std::string& words :
         {"build " + model + " -o model.tpk", "build " + folder.file("kit/kit.ifc") + " -o ifc.tpk",
          "render " + shown + " -o pictures", "session " + shown + " --gather 0.5"}) {
      SCOPED_TRACE(std::to_string(processes) + " processes: " + words);
      const Ended ended = run_limited(words, processes);
      std::istringstream lines(ended.said);
      int complaints = 0;
      for (std::string line; std::getline(lines, line);) complaints += line.starts_with("triptych: ");
      EXPECT_TRUE(ended.code == 0 || ended.code == 1) << ended.code << ": " << ended.said;
      EXPECT_EQ(complaints, ended.code) << ended.said;
      EXPECT_EQ(ended.said.find("terminate called"), std::string::npos) << ended.said;
      failed += ended.code == 1;
    }
  }
  EXPECT_GE(failed, 2) << "no limit was low enough";
}

}  // namespace
}  // namespace triptych::test
