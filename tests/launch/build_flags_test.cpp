#include "launch/build_flags.hpp"

#include "tests/session/program.hpp"

#include <gtest/gtest.h>
#include <set>

namespace triptych {
namespace {

using test::Folder;

BuildFlags parse(std::vector<std::string> arguments) {
  BuildFlags flags;
  CLI::App app;
  add_build_flags(app, flags);
  add_hierarchy_flag(app, flags);
  std::reverse(arguments.begin(), arguments.end());
  app.parse(arguments);
  return flags;
}

}  // namespace

TEST(BuildFlags, name_the_simplifier_the_bound_and_the_hierarchy) {
  const BuildFlags flags =
      parse({"a.obj", "--simplifier", "meshopt", "--bound", "tight", "--hierarchy", "median_split",
             "--memory", "256M", "--bake-instances", "--part-triangles", "100", "--leaf-triangles", "200"});
  const BuildOptions options = flags.options();
  EXPECT_EQ(options.simplify.simplifier, Simplifier::meshopt);
  EXPECT_EQ(options.simplify.bound, Bound::tight);
  EXPECT_EQ(options.hierarchy, HierarchyKind::median_split);
  EXPECT_EQ(options.memory, uint64_t{256} << 20);
  EXPECT_FALSE(options.share_instances);
  EXPECT_EQ(options.part_triangles, 100u);
  EXPECT_EQ(options.leaf_triangles, 200u);
}

TEST(BuildFlags, without_flags_are_the_builds_own_options) {
  const BuildOptions given = parse({"a.obj"}).options(), own;
  EXPECT_EQ(given.simplify.simplifier, own.simplify.simplifier);
  EXPECT_EQ(given.simplify.bound, own.simplify.bound);
  EXPECT_EQ(given.memory, uint64_t{1} << 30);
  EXPECT_EQ(given.part_triangles, own.part_triangles);
  EXPECT_EQ(given.leaf_triangles, own.leaf_triangles);
  EXPECT_TRUE(given.share_instances);
  EXPECT_TRUE(parse({"a.obj"}).import.find_groups);
  EXPECT_FALSE(parse({"a.obj", "--flat"}).import.find_groups);
}

TEST(BuildFlags, keep_what_is_named_and_nothing_else) {
  const auto kept = [](const std::string& words) {
    const Kept keep = parse({"a.obj", "--keep", words}).options().keep;
    EXPECT_EQ(parse({"a.obj", "--keep", name_of(keep)}).options().keep.touching, keep.touching);
    return std::pair(keep.touching, keep.cover);
  };
  EXPECT_EQ(kept("touching"), std::pair(true, false));
  EXPECT_EQ(kept("cover"), std::pair(false, true));
  EXPECT_EQ(kept("touching,cover"), std::pair(true, true));
  EXPECT_EQ(kept("none"), std::pair(false, false));
}

TEST(BuildFlags, unknown_words_and_too_little_memory_are_usage_errors) {
  for (const std::vector<std::string>& wrong : {std::vector<std::string>{"--simplifier", "best"},
                                                {"--bound", "0"},
                                                {"--hierarchy", "flat"},
                                                {"--memory", "127M"},
                                                {"--memory", "0"},
                                                {"--memory", "-1G"},
                                                {"--memory", "1X"},
                                                {"--memory", ""},
                                                {"--memory", "99999999999G"},
                                                {"--part-triangles", "0"},
                                                {"--keep", "touching,none"},
                                                {"--keep", "distances"},
                                                {"--keep", ""},
                                                {"--up", "x"},
                                                {"--unit", "parsec"}}) {
    std::vector<std::string> arguments = {"a.obj"};
    arguments.insert(arguments.end(), wrong.begin(), wrong.end());
    EXPECT_THROW(parse(arguments), CLI::ParseError) << wrong[0] << " " << wrong[1];
  }
  EXPECT_EQ(parse({"a.obj", "--memory", "128M"}).options().memory, uint64_t{128} << 20);
}

TEST(BuildFlags, as_arguments_give_the_same_flags_again) {
  const BuildFlags flags =
      parse({"a.obj", "--up", "z", "--unit", "ft", "--simplifier", "openmesh", "--bound", "tight", "--memory",
             "2G", "--bake-instances", "--flat", "--hierarchy", "median_split", "--leaf-triangles", "77"});
  const std::vector<std::string> arguments = build_arguments(flags);
  EXPECT_EQ(build_arguments(parse(arguments)), arguments);
  EXPECT_EQ(parse(arguments).import.unit, LengthUnit::foot);
}

TEST(BuildFlags, as_words_say_what_decides_about_the_pack_and_nothing_else) {
  const PackOptions words = build_words(parse({"a.obj"}));
  EXPECT_EQ(words.at("keep"), name_of(BuildOptions().keep));
  EXPECT_EQ(words.at("bound"), name_of(BuildOptions().simplify.bound));
  EXPECT_EQ(words.at("flat"), "no");
  EXPECT_EQ(words, build_words(parse({"/tmp/b.obj", "--memory", "2G"})));
  for (const std::vector<std::string>& flag : {std::vector<std::string>{"--up", "z"},
                                               {"--unit", "mm"},
                                               {"--chord", "0.5"},
                                               {"--simplifier", "openmesh"},
                                               {"--bound", "tight"},
                                               {"--hierarchy", "median_split"},
                                               {"--bake-instances"},
                                               {"--flat"},
                                               {"--part-triangles", "99"},
                                               {"--leaf-triangles", "99"},
                                               {"--hlod-triangles", "99"},
                                               {"--keep", "none"}}) {
    std::vector<std::string> arguments = {"a.obj"};
    arguments.insert(arguments.end(), flag.begin(), flag.end());
    EXPECT_EQ(build_words(parse(arguments)).at(flag[0].substr(2)), flag.size() > 1 ? flag[1] : "yes");
  }
}

TEST(BuildFingerprint, changes_with_every_flag_that_changes_the_pack_and_with_the_files) {
  const Folder folder;
  const std::string model = folder.file("model.obj");
  std::ofstream(model) << "v 0 0 0\n";
  std::set<std::string> fingerprints;
  size_t variants = 0;
  const auto add = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {model};
    arguments.insert(arguments.end(), more.begin(), more.end());
    fingerprints.insert(build_fingerprint(parse(arguments), {model}));
    EXPECT_EQ(fingerprints.size(), ++variants) << more.empty();
  };
  add({});
  for (const std::vector<std::string>& flag : {std::vector<std::string>{"--up", "z"},
                                               {"--unit", "mm"},
                                               {"--simplifier", "openmesh"},
                                               {"--bound", "tight"},
                                               {"--hierarchy", "median_split"},
                                               {"--bake-instances"},
                                               {"--flat"},
                                               {"--part-triangles", "99"},
                                               {"--leaf-triangles", "99"}})
    add(flag);
  std::filesystem::last_write_time(model,
                                   std::filesystem::last_write_time(model) + std::chrono::nanoseconds(1000));
  add({});
  std::ofstream(model, std::ios::app) << "v 0 0 1\n";
  add({});
}

TEST(BuildFingerprint, is_the_same_for_the_same_input_and_says_which_file_is_gone) {
  const Folder folder;
  const std::string model = folder.file("model.obj");
  std::ofstream(model) << "v 0 0 0\n";
  EXPECT_EQ(build_fingerprint(parse({model}), {model}), build_fingerprint(parse({model}), {model}));
  std::filesystem::remove(model);
  EXPECT_THROW(build_fingerprint(parse({model}), {model}), std::runtime_error);
}

}  // namespace triptych
