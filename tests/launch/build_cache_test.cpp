// Builds that take from a cache what an earlier one made: less work, and the same bytes.
#include "tests/session/program.hpp"

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

TEST_F(CachedBuild, with_other_flags_does_all_of_it_again) {
  cached("first.tpk");
  EXPECT_EQ(cached("second.tpk", {"--simplifier", "meshopt"}), 0);
  run(words("whole.tpk", {"--simplifier", "meshopt"}));
  EXPECT_TRUE(equal("second.tpk", "whole.tpk"));
}

TEST_F(CachedBuild, does_not_write_its_cache_over_a_file_of_the_model) {
  const std::string scene = folder.file("plant/scene.bin"), before = text_of(scene);
  failure(words("a.tpk", {"--cache", scene}));
  EXPECT_EQ(text_of(scene), before);
}

}  // namespace
}  // namespace triptych::test
