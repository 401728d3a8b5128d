// `--memory` and `--device-memory`: what the process takes of the machine, as the system counts it.
#include "tests/session/program.hpp"

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

}  // namespace
}  // namespace triptych::test
