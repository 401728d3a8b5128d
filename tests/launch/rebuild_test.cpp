// Models of several files, of which one changes: what is of the others is not made again.
#include "tests/session/program.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace triptych::test {
namespace {

/// A house of four storeys, a file each.
class Rebuild : public testing::Test {
 protected:
  Rebuild() {
    for (int storey = 0; storey < 4; ++storey) files.push_back(storey_file(storey, storey + 1));
    make("first.tpk", files, "cache");
  }

  /// A storey of a furnished building, lifted to its height.
  std::string storey_file(int storey, int seed) const {
    const std::string folder_name = std::to_string(storey) + "-" + std::to_string(seed);
    run({"sample", "building", "-o", folder.file(folder_name), "--floors", "1", "--furniture", "12", "--seed",
         std::to_string(seed)});
    const std::string file = folder.file(folder_name + "/scene.gltf");
    change(file, file, [&](nlohmann::json& model) {
      nlohmann::json& roots = model["scenes"][0]["nodes"];
      model["nodes"].push_back({{"children", roots}, {"translation", {0, 4.5 * storey, 0}}});
      roots = {model["nodes"].size() - 1};
      if (storey > 0) return;
      // Colours that no other file has, and that nothing shows.
      for (int i = 0; i < 200; ++i)
        model["materials"].push_back(
            {{"pbrMetallicRoughness", {{"baseColorFactor", {i / 255.0, 0.5, 0.1, 1}}}}});
    });
    return file;
  }

  template <typename Change>
  static void change(const std::string& from, const std::string& to, const Change& change) {
    nlohmann::json model = nlohmann::json::parse(text_of(from));
    change(model);
    std::ofstream(to) << model;
  }

  /// Builds with a cache; how much of the levels was made, by the names of `cache.kinds`.
  nlohmann::json make(const std::string& pack, const std::vector<std::string>& inputs,
                      const std::string& cache) const {
    std::vector<std::string> words = {"build", "-o", folder.file(pack), "--json", folder.file("json")};
    if (!cache.empty()) words.insert(words.end(), {"--cache", folder.file(cache)});
    words.insert(words.end(), inputs.begin(), inputs.end());
    run(words);
    const nlohmann::json report = json_of(folder.file("json"));
    return cache.empty() ? nlohmann::json() : report["cache"]["kinds"];
  }

  /// The same with what the first build left, and a look whether the pack is that of a build from nothing.
  nlohmann::json again(const std::vector<std::string>& inputs) const {
    nlohmann::json kinds = make("again.tpk", inputs, "cache");
    make("whole.tpk", inputs, "");
    EXPECT_TRUE(text_of(folder.file("again.tpk")) == text_of(folder.file("whole.tpk")));
    return kinds;
  }

  static double made(const nlohmann::json& kinds, const char* kind) { return kinds[kind]["made"]; }
  static double share_made(const nlohmann::json& kinds, const char* kind) {
    const double found = kinds[kind]["found"];
    return made(kinds, kind) / (found + made(kinds, kind));
  }

  static constexpr const char *parts = "levels of parts", *nodes = "levels of scene nodes";
  Folder folder;
  std::vector<std::string> files;
};

TEST_F(Rebuild, of_a_file_that_is_replaced_makes_what_is_of_it_and_what_stands_beside_it) {
  files[2] = storey_file(2, 12);
  const nlohmann::json alone = make("alone.tpk", {files[2]}, "alone");
  const nlohmann::json kinds = again(files);
  const double all_parts = made(kinds, parts) / share_made(kinds, parts);
  const double all_nodes = made(kinds, nodes) / share_made(kinds, nodes);
  EXPECT_LT(made(kinds, parts), made(alone, parts) + 0.05 * all_parts);
  EXPECT_LT(made(kinds, nodes), made(alone, nodes) + 0.25 * all_nodes);
}

TEST_F(Rebuild, of_a_file_with_another_name_makes_nothing) {
  std::filesystem::rename(files[1], folder.file("2-1.gltf"));
  std::filesystem::rename(folder.file("1-2/scene.bin"), folder.file("scene.bin"));
  files[1] = folder.file("2-1.gltf");
  const nlohmann::json kinds = again(files);
  for (const auto& [kind, count] : kinds.items()) EXPECT_EQ(count["made"], 0) << kind;
}

TEST_F(Rebuild, of_files_in_another_order_makes_little) {
  std::swap(files[0], files[3]);
  std::swap(files[1], files[2]);
  const nlohmann::json kinds = again(files);
  EXPECT_LT(share_made(kinds, parts), 0.1);
  EXPECT_LT(share_made(kinds, nodes), 0.2);
}

TEST_F(Rebuild, without_one_of_the_files_keeps_what_is_of_the_others) {
  files.erase(files.begin());  // which has most of the colours
  const nlohmann::json kinds = again(files);
  EXPECT_LT(share_made(kinds, parts), 0.2);
  EXPECT_LT(share_made(kinds, nodes), 0.5);
}

TEST_F(Rebuild, with_one_file_more_keeps_what_there_was) {
  files.insert(files.begin() + 1, storey_file(4, 5));
  const nlohmann::json alone = make("alone.tpk", {files[1]}, "alone");
  const nlohmann::json kinds = again(files);
  const double all = made(kinds, parts) / share_made(kinds, parts);
  EXPECT_LT(made(kinds, parts), made(alone, parts) + 0.2 * all);
}

TEST_F(Rebuild, of_one_object_more_makes_little) {
  change(files[2], files[2], [](nlohmann::json& model) {
    nlohmann::json& all = model["nodes"];
    size_t last = all.size();
    while (!all[last - 1].contains("mesh")) --last;
    nlohmann::json more = all[last - 1];
    all.push_back(more);
    all.push_back({{"children", {all.size() - 1}}, {"translation", {0.73, 0, 0}}});
    nlohmann::json& root = all[model["scenes"][0]["nodes"][0].get<size_t>()];
    root["children"].push_back(all.size() - 1);
  });
  const nlohmann::json kinds = again(files);
  EXPECT_LT(share_made(kinds, parts), 0.05);
  EXPECT_LT(share_made(kinds, nodes), 0.1);
}

}  // namespace
}  // namespace triptych::test
