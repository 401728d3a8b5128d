// Builds that take from a cache what an earlier one made: less work, and the
// same bytes.
#include "tests/session/program.hpp"

#include <fstream>
#include <gtest/gtest.h>

namespace triptych::test {
namespace {

class CachedBuild : public testing::Test {
 protected:
  CachedBuild() {
    sample("building", "building", {"--floors", "1", "--furniture", "40"});
    sample("statue", "statue", {"--triangles", "40000"});
    sample("plant", "plant", {"--triangles", "60000"});
  }

  void sample(const std::string& name, const std::string& folder_name,
              const std::vector<std::string>& flags) {
    std::vector<std::string> words = {"sample", name, "-o", folder.file(folder_name)};
    words.insert(words.end(), flags.begin(), flags.end());
    run(words);
  }

  std::vector<std::string> words(const std::string& pack, const std::vector<std::string>& more) const {
    std::vector<std::string> all = {"build",
                                    folder.file("building/scene.gltf"),
                                    folder.file("statue/scene.ply"),
                                    folder.file("plant/scene.gltf"),
                                    "-o",
                                    folder.file(pack)};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  /// Builds with the cache; which share of the work was found there.
  double cached(const std::string& pack, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all =
        words(pack, {"--cache", folder.file("cache"), "--json", folder.file("json")});
    all.insert(all.end(), more.begin(), more.end());
    run(all);
    const nlohmann::json cache = json_of(folder.file("json"))["cache"];
    const double found = cache["found"], made = cache["made"];
    EXPECT_EQ(cache["bytes"], std::filesystem::file_size(folder.file("cache")));
    return found / (found + made);
  }

  bool equal(const std::string& one, const std::string& other) const {
    return text_of(folder.file(one)) == text_of(folder.file(other));
  }

  Folder folder;
};

TEST_F(CachedBuild, gives_the_same_bytes_and_does_the_work_once) {
  run(words("plain.tpk", {}));
  EXPECT_EQ(cached("first.tpk", {"--threads", "1"}), 0);
  EXPECT_TRUE(equal("first.tpk", "plain.tpk"));
  EXPECT_EQ(cached("again.tpk"), 1);
  EXPECT_TRUE(equal("again.tpk", "plain.tpk"));
}

TEST_F(CachedBuild,
       after_one_of_the_files_has_changed_does_what_is_new_and_gives_the_bytes_of_a_whole_build) {
  cached("first.tpk");
  sample("statue", "statue", {"--triangles", "40000", "--seed", "2"});
  const double found = cached("second.tpk");
  EXPECT_GT(found, 0.1);
  EXPECT_LT(found, 1);
  run(words("whole.tpk", {}));
  EXPECT_FALSE(equal("whole.tpk", "first.tpk"));
  EXPECT_TRUE(equal("second.tpk", "whole.tpk"));
}

TEST_F(CachedBuild, with_other_flags_does_again_what_depends_on_them) {
  cached("first.tpk");
  EXPECT_LT(cached("second.tpk", {"--simplifier", "meshopt"}), 0.9);
  run(words("whole.tpk", {"--simplifier", "meshopt"}));
  EXPECT_TRUE(equal("second.tpk", "whole.tpk"));
}

TEST_F(CachedBuild, where_nothing_changed_only_copies_the_pack_and_says_the_same) {
  cached("first.tpk");
  const nlohmann::json first = json_of(folder.file("json"));
  const std::string cache = text_of(folder.file("cache"));
  EXPECT_EQ(cached("again.tpk"), 1);
  const nlohmann::json again = json_of(folder.file("json"));
  EXPECT_EQ(again["stages"].size(), 1);
  EXPECT_EQ(again["stages"][0]["name"], "copy");
  EXPECT_TRUE(equal("again.tpk", "first.tpk"));
  EXPECT_EQ(text_of(folder.file("cache")), cache);
  for (const char* key :
       {"source_triangles", "levels", "contacts", "layered_facets", "import", "crowded_parts"})
    EXPECT_EQ(again[key], first[key]) << key;
}

TEST_F(CachedBuild, notices_a_file_that_a_model_names) {
  cached("first.tpk");
  // Another position, and nothing else of the model.
  const std::string buffer = folder.file("building/scene.bin");
  std::string bytes = text_of(buffer);
  bytes[2] = static_cast<char>(bytes[2] ^ 0x20);
  std::ofstream(buffer, std::ios::binary) << bytes;
  EXPECT_GT(cached("second.tpk"), 0.5);
  EXPECT_GT(json_of(folder.file("json"))["stages"].size(), 1);  // it was no copy
  run(words("whole.tpk", {}));
  EXPECT_TRUE(equal("second.tpk", "whole.tpk"));
}

TEST_F(CachedBuild, whose_cache_is_damaged_gives_the_same_bytes) {
  cached("first.tpk");
  const std::string whole = text_of(folder.file("cache"));
  for (const double share : {0.1, 0.6, 0.9}) {  // units of work, the pack
    std::string bytes = whole;
    const auto at = static_cast<size_t>(share * static_cast<double>(bytes.size()));
    for (size_t i = at; i < at + 5000; ++i) bytes[i] = static_cast<char>(bytes[i] ^ 1);
    std::ofstream(folder.file("cache"), std::ios::binary) << bytes;
    cached("again.tpk");
    EXPECT_TRUE(equal("again.tpk", "first.tpk")) << share;
  }
}

TEST_F(CachedBuild, that_is_killed_leaves_the_cache_as_it_was) {
  cached("first.tpk");
  const std::string cache = text_of(folder.file("cache"));
  sample("statue", "statue", {"--triangles", "40000", "--seed", "2"});
  {
    Program build(words("second.tpk", {"--cache", folder.file("cache")}));
    while (!std::filesystem::exists(folder.file("second.tpk.work/parts")) &&
           !std::filesystem::exists(folder.file("second.tpk")))
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    build.signal(SIGKILL);
    build.wait();
  }
  EXPECT_EQ(text_of(folder.file("cache")), cache);
  cached("second.tpk");
  run(words("whole.tpk", {}));
  EXPECT_TRUE(equal("second.tpk", "whole.tpk"));
  for (const auto& entry : std::filesystem::directory_iterator(folder.file(".")))
    EXPECT_EQ(entry.path().string().find("partial"), std::string::npos) << entry.path();
}

TEST_F(CachedBuild, beside_another_one_with_the_same_file_gives_its_own_bytes) {
  cached("first.tpk");
  sample("statue", "statue", {"--triangles", "40000", "--seed", "2"});
  Program one(words("one.tpk", {"--cache", folder.file("cache")}));
  Program other(words("other.tpk", {"--cache", folder.file("cache"), "--simplifier", "meshopt"}));
  EXPECT_EQ(one.wait(), 0) << one.errors();
  EXPECT_EQ(other.wait(), 0) << other.errors();
  run(words("whole.tpk", {}));
  EXPECT_TRUE(equal("one.tpk", "whole.tpk"));
  run(words("meshopt.tpk", {"--simplifier", "meshopt"}));
  EXPECT_TRUE(equal("other.tpk", "meshopt.tpk"));
}

TEST_F(CachedBuild, within_a_limit_gives_the_same_bytes_and_keeps_revisions_as_long_as_there_is_room) {
  const std::string ample = "200M", tight = "1M";
  cached("first.tpk", {"--cache-limit", ample});
  sample("statue", "statue", {"--triangles", "40000", "--seed", "2"});
  cached("second.tpk", {"--cache-limit", ample});
  sample("statue", "statue", {"--triangles", "40000"});
  EXPECT_EQ(cached("again.tpk", {"--cache-limit", ample}), 1);  // back to the first revision
  EXPECT_TRUE(equal("again.tpk", "first.tpk"));
  EXPECT_LT(cached("tight.tpk", {"--cache-limit", tight, "--up", "y", "--simplifier", "collapse",
                                 "--part-triangles", "2000"}),
            1);
  EXPECT_LE(std::filesystem::file_size(folder.file("cache")), 1u << 20);
  EXPECT_GT(json_of(folder.file("json"))["cache"]["left_out_bytes"], 0);
  cached("small.tpk", {"--cache-limit", tight});
  EXPECT_TRUE(equal("small.tpk", "first.tpk"));
}

TEST_F(CachedBuild, does_not_write_its_cache_over_a_file_of_the_model) {
  const std::string scene = folder.file("plant/scene.bin"), before = text_of(scene);
  failure(words("a.tpk", {"--cache", scene}));
  EXPECT_EQ(text_of(scene), before);
}

}  // namespace
}  // namespace triptych::test
