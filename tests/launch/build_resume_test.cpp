// Builds that are killed, starved of disk, or raced.
#include "base/clock.hpp"
#include "tests/session/program.hpp"

#include <algorithm>
#include <fstream>
#include <random>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace triptych {
namespace {

using test::Folder;
using test::Program;

/// Several hundred objects and one of half a million triangles' share: enough work to be killed in.
std::string make_plant(const Folder& folder) {
  test::run({"sample", "plant", "-o", folder.file("plant"), "--triangles", "600000"});
  return folder.file("plant") + "/scene.gltf";
}

std::vector<std::string> build_arguments(const std::string& model, const std::string& pack) {
  return {"build", model, "-o", pack, "--memory", "128M"};
}

/// Whether the build has left a good part of its work, and not its pack.
bool is_half_done(const std::string& pack) {
  std::error_code none;
  if (std::filesystem::exists(pack)) return false;
  for (const char* name : {"journal", "parts", "surfaces", "pack", "pack.pieces"}) {
    const uint64_t size = std::filesystem::file_size(pack + ".work/" + name, none);
    if (none || size <= 2000) return false;
  }
  return true;
}

/// A build that is killed when a good part of it is done. Where the machine is busy it may be over by then,
/// or be putting its work away: it is begun anew.
void kill_late(const std::string& model, const std::string& pack) {
  while (true) {
    Program build(build_arguments(model, pack));
    const std::string journal = pack + ".work/journal";
    const auto late = [&] {
      std::error_code none;
      const uint64_t size = std::filesystem::file_size(journal, none);
      // The record of a batch of leaves, up to 717,000, is whole: the next one's has begun.
      return !none && size > 750'000;
    };
    while (!late() && !std::filesystem::exists(pack))
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    build.signal(SIGKILL);
    if (build.wait() == -SIGKILL && is_half_done(pack)) return;
    std::filesystem::remove(pack);
    std::filesystem::remove_all(pack + ".work");
  }
}

TEST(BuildResume, twenty_kills_leave_the_same_bytes_and_the_work_done_before_counts) {
  const Folder folder;
  const std::string model = make_plant(folder);
  const std::string whole = folder.file("whole.tpk"), killed = folder.file("killed.tpk");
  const Stopwatch stopwatch;
  test::run(build_arguments(model, whole));
  // Kills come at any time of a build, however busy the machine is.
  const auto duration_ms = static_cast<uint32_t>(std::clamp(stopwatch.milliseconds(), 400.0, 5000.0));

  std::mt19937 random(7);
  int kills = 0, resumed = 0;
  uint64_t done = 0;  // units of work that a run found done; they only become more until one finishes
  while (kills < 20) {
    Program build(build_arguments(model, killed));
    std::this_thread::sleep_for(std::chrono::milliseconds(20 + random() % duration_ms));
    build.signal(SIGKILL);
    const int code = build.wait();
    const std::string said = build.errors();
    if (const size_t at = said.find("resuming: "); at != std::string::npos) {
      ++resumed;
      const uint64_t found = std::stoull(said.substr(at + 10));
      EXPECT_GE(found, done) << "work that had been done was lost";
      done = found;
    }
    if (code == -SIGKILL) {
      ++kills;
      if (!std::filesystem::exists(killed)) continue;
    } else {
      ASSERT_EQ(code, 0) << build.errors();
    }
    // It was done before the signal came: the same bytes, and again from the start.
    ASSERT_EQ(test::text_of(killed), test::text_of(whole));
    std::filesystem::remove(killed);
    done = 0;
  }
  // Killed once more where a good part is done: the last run does the rest alone.
  kill_late(model, killed);
  const std::string json = folder.file("last.json");
  std::vector<std::string> arguments = build_arguments(model, killed);
  arguments.insert(arguments.end(), {"--json", json});
  Program last(arguments);
  ASSERT_EQ(last.wait(), 0) << last.errors();
  EXPECT_EQ(test::text_of(killed), test::text_of(whole));
  EXPECT_GT(resumed, 5);
  EXPECT_GT(test::json_of(json)["resumed_units"].get<uint64_t>(), 0u);
  EXPECT_FALSE(std::filesystem::exists(killed + ".work"));
}

TEST(BuildResume, kept_files_that_were_changed_are_an_error_and_no_pack) {
  const Folder folder;
  const std::string model = make_plant(folder), pack = folder.file("a.tpk");
  for (const std::string name : {"parts", "surfaces", "pack", "pack.pieces"}) {
    for (const bool cut : {false, true}) {
      SCOPED_TRACE(name + (cut ? " cut" : " changed"));
      kill_late(model, pack);
      const std::string file = pack + ".work/" + name;
      ASSERT_GT(std::filesystem::file_size(file), 2000u);
      if (cut) {
        std::filesystem::resize_file(file, 1000);
      } else {
        std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
        bytes.seekg(1000);
        const int byte = bytes.get();
        bytes.seekp(1000);
        bytes.put(static_cast<char>(byte ^ 1));
      }
      const std::string complaint = test::failure(build_arguments(model, pack));
      EXPECT_NE(complaint.find(file + ": " + (cut ? "does not hold" : "was changed")), std::string::npos)
          << complaint;
      EXPECT_FALSE(std::filesystem::exists(pack));
      EXPECT_FALSE(std::filesystem::exists(pack + ".work"));
    }
  }
}

TEST(BuildResume, a_kill_just_before_the_pack_has_its_name_costs_nothing) {
  const Folder folder;
  const std::string model = make_plant(folder), pack = folder.file("a.tpk"), whole = folder.file("whole.tpk");
  test::run(build_arguments(model, whole));
  kill_late(model, pack);
  // The skeleton and the table are written by then, and the header too.
  std::fstream bytes(pack + ".work/pack", std::ios::in | std::ios::out | std::ios::binary);
  bytes << test::text_of(whole).substr(0, 32);
  bytes.seekp(0, std::ios::end);
  bytes << test::text_of(whole).substr(0, 1000);
  bytes.close();
  Program build(build_arguments(model, pack));
  ASSERT_EQ(build.wait(), 0) << build.errors();
  EXPECT_NE(build.errors().find("resuming: "), std::string::npos) << build.errors();
  EXPECT_EQ(test::text_of(pack), test::text_of(whole));
}

TEST(BuildResume, work_that_lacks_a_file_is_done_again) {
  const Folder folder;
  const std::string model = make_plant(folder), pack = folder.file("a.tpk");
  test::run(build_arguments(model, folder.file("whole.tpk")));
  kill_late(model, pack);
  // As after a kill between the pack's renaming and the journal's removal.
  std::filesystem::remove(pack + ".work/pack");
  Program build(build_arguments(model, pack));
  ASSERT_EQ(build.wait(), 0) << build.errors();
  EXPECT_NE(build.errors().find("a file of it is missing"), std::string::npos) << build.errors();
  EXPECT_EQ(test::text_of(pack), test::text_of(folder.file("whole.tpk")));
}

TEST(BuildResume, a_build_that_cannot_begin_leaves_nothing) {
  const Folder folder;
  const std::string model = make_plant(folder);
  const size_t before = folder.files();
  struct rlimit old {};
  ::getrlimit(RLIMIT_NOFILE, &old);
  for (rlim_t files = 4; files < 12; ++files) {
    const struct rlimit few { files, old.rlim_max };
    pid_t child = ::fork();
    if (child == 0) {
      ::setrlimit(RLIMIT_NOFILE, &few);
      ::execl(TRIPTYCH_PROGRAM, "triptych", "build", model.c_str(), "-o", folder.file("a.tpk").c_str(),
              nullptr);
      ::_exit(127);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status)) << files;
    std::filesystem::remove(folder.file("a.tpk"));
    EXPECT_EQ(folder.files(), before) << "with " << files << " open files";
    EXPECT_FALSE(std::filesystem::exists(folder.file("a.tpk.work"))) << files;
  }
}

TEST(BuildResume, another_model_of_the_same_name_is_built_from_the_start) {
  const Folder folder;
  const std::string model = make_plant(folder);
  const std::string pack = folder.file("a.tpk");
  {
    Program build(build_arguments(model, pack));
    while (!std::filesystem::exists(pack + ".work/journal") ||
           std::filesystem::file_size(pack + ".work/journal") == 0) {
      ASSERT_FALSE(std::filesystem::exists(pack));
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    build.signal(SIGKILL);
    build.wait();
  }
  test::run({"sample", "plant", "-o", folder.file("plant"), "--triangles", "600000", "--seed", "5"});
  Program build(build_arguments(model, pack));
  ASSERT_EQ(build.wait(), 0) << build.errors();
  EXPECT_EQ(build.errors().find("resuming"), std::string::npos);
  EXPECT_NE(build.errors().find("what another build left is dropped"), std::string::npos) << build.errors();
  test::run(build_arguments(model, folder.file("b.tpk")));
  EXPECT_EQ(test::text_of(pack), test::text_of(folder.file("b.tpk")));
}

TEST(BuildResume, a_disk_that_is_full_ends_with_one_line_and_leaves_nothing) {
  const Folder folder;
  const std::string model = make_plant(folder);
  const size_t before = folder.files();
  // A limit of the size of files stands for the disk: writes beyond it fail in the same way.
  struct rlimit old {};
  ::getrlimit(RLIMIT_FSIZE, &old);
  ::signal(SIGXFSZ, SIG_IGN);  // inherited: the write fails instead
  const struct rlimit small { 4 << 20, old.rlim_max };
  ::setrlimit(RLIMIT_FSIZE, &small);
  const std::string complaint = test::failure(build_arguments(model, folder.file("a.tpk")));
  ::setrlimit(RLIMIT_FSIZE, &old);
  ::signal(SIGXFSZ, SIG_DFL);
  EXPECT_NE(complaint.find("cannot be written"), std::string::npos) << complaint;
  EXPECT_EQ(folder.files(), before);
}

TEST(BuildResume, two_builds_of_one_pack_do_not_meet) {
  const Folder folder;
  const std::string model = make_plant(folder);
  const std::string pack = folder.file("a.tpk");
  Program first(build_arguments(model, pack));
  while (!std::filesystem::exists(pack + ".work/lock"))
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const std::string complaint = test::failure(build_arguments(model, pack));
  EXPECT_NE(complaint.find("another process"), std::string::npos) << complaint;
  EXPECT_EQ(first.wait(), 0) << first.errors();
}

}  // namespace
}  // namespace triptych
