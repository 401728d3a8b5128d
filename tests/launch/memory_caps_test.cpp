// `--memory` and `--device-memory`: what the process takes of the machine, as the system counts it.
#include "tests/session/program.hpp"
#include "tests/support/range_server.hpp"

#include <algorithm>
#include <filesystem>

namespace triptych::test {
namespace {

constexpr uint64_t mebibyte = uint64_t{1} << 20;

class MemoryCaps : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    shared = std::filesystem::path(testing::TempDir()) / ("triptych_caps_" + std::to_string(::getpid()));
    run({"sample", "isosurface", "-o", (shared / "s").string(), "--triangles", "400000"});
    run({"build", (shared / "s/scene.ply").string(), "-o", (shared / "s.tpk").string()});
  }
  static void TearDownTestSuite() { std::filesystem::remove_all(shared); }

  std::vector<std::string> words(const std::vector<std::string>& first,
                                 const std::vector<std::string>& more) const {
    std::vector<std::string> all = first;
    for (const char* word : {"--path", "PATH", "--device", "cpu", "--frames", "12", "--json", "JSON"})
      all.push_back(word == std::string("PATH")   ? (shared / "s/walk.json").string()
                    : word == std::string("JSON") ? json
                                                  : word);
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  std::vector<std::string> render(const std::string& output, const std::vector<std::string>& more) const {
    std::vector<std::string> all = words({"render", (shared / "s.tpk").string()}, more);
    all.insert(all.end(), {"-o", folder.file(output)});
    return all;
  }
  /// The pictures of a run, by name.
  std::map<std::string, std::string> pictures(const std::string& output) const {
    std::map<std::string, std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder.file(output)))
      if (entry.path().extension() == ".png") found[entry.path().filename()] = text_of(entry.path());
    return found;
  }

  static std::filesystem::path shared;
  Folder folder;
  const std::string json = folder.file("out.json");
};
std::filesystem::path MemoryCaps::shared;

TEST_F(MemoryCaps, pictures_are_the_same_and_the_process_stays_below_its_cap) {
  run(render("whole", {}));
  const uint64_t whole = json_of(json)["peak_rss_bytes"];
  EXPECT_FALSE(json_of(json).contains("memory_cap"));
  // Room for what a frame shows, and not for all that the frames together do.
  Program capped(render("capped", {"--memory", "96M", "--device-memory", "8M"}));
  ASSERT_EQ(capped.wait(), 0) << capped.errors();
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  EXPECT_LE(capped.peak_bytes(), 96 * mebibyte) << "and without a cap " << whole;
#endif
  const nlohmann::json report = json_of(json);
  EXPECT_EQ(report["memory_cap"], 96 * mebibyte);
  EXPECT_EQ(report["device_cap"], 8 * mebibyte);
  EXPECT_LE(report["peak_device_bytes"], 8 * mebibyte);
  EXPECT_EQ(report["series"]["pixel_error"].size(), 12u);
  EXPECT_EQ(pictures("capped").size(), 12u);
  ASSERT_EQ(report["raised_frames"], 0) << "8 MiB hold what a frame shows";
  EXPECT_EQ(pictures("capped"), pictures("whole"));
}

TEST_F(MemoryCaps, a_frame_without_room_is_coarser_and_says_how_coarse) {
  run(render("capped", {"--device-memory", "2M"}));
  const nlohmann::json report = json_of(json);
  EXPECT_LE(report["peak_device_bytes"], 2 * mebibyte);
  EXPECT_GT(report["raised_frames"], 0);
  const auto errors = report["series"]["pixel_error"].get<std::vector<double>>();
  EXPECT_EQ(*std::max_element(errors.begin(), errors.end()), report["raised_pixel_error_max"].get<double>());
  EXPECT_GT(report["raised_pixel_error_max"], 1);
  EXPECT_GT(report["evicted_chunks"], 0);
}

TEST_F(MemoryCaps, what_cannot_work_is_one_error_that_names_what_would) {
  for (const std::vector<std::string>& cap :
       {std::vector<std::string>{"--memory", "1M"}, {"--device-memory", "10K"}}) {
    Program refused(render("none", cap));
    EXPECT_EQ(refused.wait(), 1);
    ASSERT_EQ(refused.complaints().size(), 1u) << refused.errors();
    EXPECT_NE(refused.complaints()[0].find(cap[0] + ": "), std::string::npos) << refused.complaints()[0];
    EXPECT_NE(refused.complaints()[0].find("MiB are needed"), std::string::npos) << refused.complaints()[0];
  }
}

TEST_F(MemoryCaps, roles_of_a_session_stay_below_them_and_draw_what_one_process_does) {
  run(render("whole", {}));
  Program capped(
      words({"session", (shared / "s.tpk").string(), "--gather", "60", "-o", folder.file("session")},
            {"--memory", "96M", "--device-memory", "8M"}));
  ASSERT_EQ(capped.wait(), 0) << capped.errors();
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  EXPECT_LE(capped.peak_bytes(), 96 * mebibyte) << "of a role";
#endif
  const nlohmann::json report = json_of(json);
  EXPECT_EQ(report["memory_cap"], 96 * mebibyte);
  EXPECT_EQ(report["fallback_frames"], 0);
  EXPECT_EQ(report["series"]["pixel_error"].size(), 12u);
  for (const char* role : {"render node", "switch node 0", "switch node 1"}) {
    const nlohmann::json& memory = report["memory"][role];
    EXPECT_LE(memory["peak_rss_bytes"], 96 * mebibyte) << role;
    EXPECT_GT(memory["peak_device_bytes"], 0) << role;
    EXPECT_LE(memory["peak_device_bytes"], 8 * mebibyte) << role;
  }
  ASSERT_EQ(report["raised_frames"], 0) << "8 MiB hold what a frame shows";
  EXPECT_EQ(pictures("session").size(), 12u);
  EXPECT_EQ(pictures("session"), pictures("whole"));
}

TEST_F(MemoryCaps, a_session_without_room_says_how_coarse_it_is) {
  run(words({"session", (shared / "s.tpk").string(), "--gather", "60", "-o", folder.file("session")},
            {"--device-memory", "2M"}));
  const nlohmann::json report = json_of(json);
  EXPECT_GT(report["raised_frames"], 0);
  EXPECT_GT(report["raised_pixel_error_max"], 1);
  EXPECT_EQ(report["digest_mismatches"], 0);
  for (const auto& [role, memory] : report["memory"].items())
    EXPECT_LE(memory["peak_device_bytes"], 2 * mebibyte) << role;
}

TEST_F(MemoryCaps, streaming_is_measured) {
  run(words({"measure", "streaming", (shared / "s.tpk").string()},
            {"--memory", "200M", "--device-memory", "8M", "--rounds", "2"}));
  const nlohmann::json report = json_of(json);
  EXPECT_EQ(report["frames"], 24);
  EXPECT_GT(report["misses"], 0);
  EXPECT_LE(report["waits"], report["misses"]);
  EXPECT_GT(report["hits"], report["misses"]);
  EXPECT_GT(report["bytes_read"], 0);
  EXPECT_TRUE(report["prefetch"].contains("precision"));
  EXPECT_TRUE(report["prefetch"].contains("recall"));
  EXPECT_EQ(report["raised_pixel_error_max"], 1);
}

class WebPacks : public MemoryCaps {
 protected:
  std::vector<std::string> remote(const std::string& command, const std::vector<std::string>& more = {}) {
    return words({command, server.address("s.tpk"), "-o", folder.file(command)}, more);
  }
  RangeServer server{text_of(shared / "s.tpk")};
};

TEST_F(WebPacks, are_drawn_as_from_a_file_over_a_slow_and_broken_network) {
  run(render("whole", {}));
  server.delay_ms = 5;
  server.cut_every = 7;
  run(remote("render"));
  EXPECT_EQ(pictures("render"), pictures("whole"));
  run(remote("render", {"--memory", "96M", "--device-memory", "8M"}));
  EXPECT_EQ(pictures("render"), pictures("whole"));
  EXPECT_GT(json_of(json)["misses"], 0);
}

TEST_F(WebPacks, are_drawn_by_sessions_and_told_of) {
  run(render("whole", {}));
  run(remote("session", {"--gather", "60"}));
  EXPECT_EQ(pictures("session"), pictures("whole"));
  run({"info", server.address("s.tpk"), "--json", json});
  EXPECT_EQ(json_of(json)["pack_bytes"], std::filesystem::file_size(shared / "s.tpk"));
}

TEST_F(WebPacks, that_cannot_be_read_are_one_error) {
  server.status = 404;
  Program nothing(remote("render"));
  EXPECT_EQ(nothing.wait(), 1);
  ASSERT_EQ(nothing.complaints().size(), 1u) << nothing.errors();
  EXPECT_NE(nothing.complaints()[0].find("no such file on the server"), std::string::npos);
}

}  // namespace
}  // namespace triptych::test
