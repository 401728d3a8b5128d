// Model files where a pack is shown: built once, and again where anything about them is another.
#include "tests/launch/model_files.hpp"

#include <fcntl.h>
#include <sys/file.h>

namespace triptych::test {
namespace {

using ShownModel = ModelFiles;

TEST_F(ShownModel, is_drawn_as_its_pack_is_and_built_once) {
  run({"build", model, "-o", folder.file("box.tpk")});
  EXPECT_FALSE(draws_after_a_build({folder.file("box.tpk")}, "pack"));
  EXPECT_TRUE(draws_after_a_build({model}, "model"));
  EXPECT_FALSE(draws_after_a_build({model}, "again"));
  ASSERT_FALSE(picture("pack").empty());
  EXPECT_EQ(picture("pack"), picture("model"));
  EXPECT_EQ(picture("pack"), picture("again"));
  EXPECT_EQ(cached(), 1u);
}

TEST_F(ShownModel,
       is_built_again_where_a_file_that_it_names_or_a_flag_differs_but_not_where_it_lies_elsewhere) {
  EXPECT_TRUE(draws_after_a_build({model}, "red"));
  write_model(folder.file("moved"));
  EXPECT_FALSE(draws_after_a_build({folder.file("moved/box.obj")}, "moved_red"));
  EXPECT_EQ(picture("red"), picture("moved_red"));
  write_model(folder.file("."), "0 0 1");
  EXPECT_TRUE(draws_after_a_build({model}, "blue"));
  EXPECT_NE(picture("red"), picture("blue"));
  EXPECT_TRUE(draws_after_a_build({model, "--build", "--keep none"}, "kept_none"));
  EXPECT_FALSE(draws_after_a_build({model, "--build", "--keep none"}, "kept_none"));
  std::filesystem::remove(folder.file("box.mtl"));
  EXPECT_TRUE(draws_after_a_build({model}, "grey"));
  EXPECT_NE(picture("grey"), picture("blue"));
}

TEST_F(ShownModel, is_built_again_where_a_file_differs_that_assimp_opened_beside_it) {
  const std::string scene = folder.file("scene.lws");
  std::ofstream(scene)
      << "LWSC\n3\n\nFirstFrame 0\nLastFrame 1\nFrameStep 1\n\nLoadObject box.obj\nShowObject 7 3\n";
  EXPECT_TRUE(draws_after_a_build({scene}, "one"));
  EXPECT_FALSE(draws_after_a_build({scene}, "one"));
  std::ofstream(model) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  EXPECT_TRUE(draws_after_a_build({scene}, "another"));
  EXPECT_NE(picture("one"), picture("another"));
}

TEST_F(ShownModel, is_built_by_one_of_two_processes_that_want_it_at_once) {
  std::vector<std::unique_ptr<Program>> programs;
  for (const char* json : {"a.json", "b.json", "c.json"})
    programs.push_back(
        std::make_unique<Program>(std::vector<std::string>{"info", model, "--json", folder.file(json)}));
  size_t built = 0;
  for (const auto& program : programs) {
    EXPECT_EQ(program->wait(), 0) << program->errors();
    built += program->errors().find("building a pack") != std::string::npos ? 1 : 0;
  }
  EXPECT_EQ(built, 1u);
  EXPECT_EQ(json_of(folder.file("a.json")), json_of(folder.file("c.json")));
}

TEST_F(ShownModel, is_several_files_as_in_a_build) {
  write_model(folder.file("other"), "0 1 0");
  const std::string other = folder.file("other/box.obj"), json = folder.file("two.json");
  run({"info", model, other, "--json", json});
  EXPECT_EQ(json_of(json)["source_triangles"], 24);
  EXPECT_EQ(json_of(json)["build"]["keep"], "cover,order,planes,shade,touching");
}

TEST_F(ShownModel, is_all_or_nothing_in_the_cache) {
  run({"info", model});
  const std::filesystem::path entry = *std::filesystem::directory_iterator(folder.file("cache"));
  std::ofstream(entry / "key.json") << "{";  // as if the process had been killed over it
  Program again({"info", model});
  EXPECT_EQ(again.wait(), 0);
  EXPECT_NE(again.errors().find("building a pack"), std::string::npos);
  std::filesystem::remove(entry / "box.tpk");
  run({"info", model});
  EXPECT_TRUE(std::filesystem::exists(entry / "box.tpk"));
}

TEST_F(ShownModel, that_nobody_has_wanted_for_long_leaves_the_cache) {
  const auto make_old = [&] {
    for (const auto& entry : std::filesystem::directory_iterator(folder.file("cache")))
      std::filesystem::last_write_time(
          entry.path() / "lock", std::filesystem::file_time_type::clock::now() - std::chrono::hours(24 * 61));
  };
  std::filesystem::create_directories(folder.file("cache/not-of-the-cache"));
  std::ofstream(folder.file("cache/not-of-the-cache/lock")) << "the user's";
  run({"info", model});
  make_old();
  run({"info", model});  // wanted again
  run({"info", model, "--build", "--keep none"});
  EXPECT_EQ(cached(), 3u);
  make_old();
  run({"info", model, "--build", "--keep cover"});
  EXPECT_EQ(cached(), 2u);
  EXPECT_TRUE(std::filesystem::exists(folder.file("cache/not-of-the-cache/lock")));
}

/// Entries of the cache, of packs that are no packs, that were wanted so many hours ago.
class LimitedCache : public ModelFiles {
 protected:
  std::filesystem::path entry(const std::string& name, size_t bytes, int hours) const {
    const std::filesystem::path where = folder.file("cache/" + name + "-0123456789abcdef");
    std::filesystem::create_directories(where);
    std::ofstream(where / (name + ".tpk")) << std::string(bytes, 'x');
    std::ofstream(where / "lock") << "";
    std::filesystem::last_write_time(
        where / "lock", std::filesystem::file_time_type::clock::now() - std::chrono::hours(hours));
    return where;
  }
  /// What is said when the model is built into it.
  std::string build(const std::vector<std::string>& more) const {
    std::vector<std::string> words = {"info", model};
    words.insert(words.end(), more.begin(), more.end());
    Program program(words);
    EXPECT_EQ(program.wait(), 0) << program.errors();
    return program.errors();
  }
};

TEST_F(LimitedCache, loses_what_was_wanted_the_longest_time_ago_and_says_so) {
  const auto oldest = entry("c", 400'000, 3), older = entry("a", 400'000, 2), old = entry("b", 400'000, 1),
             other = std::filesystem::path(folder.file("cache/other"));
  std::filesystem::create_directories(other);
  std::ofstream(other / "a.tpk") << std::string(2'000'000, 'x');
  // What is left of one that another process was removing when it was killed.
  const std::filesystem::path left = oldest.string() + ".partial-1";
  std::filesystem::create_directories(left);
  std::ofstream(left / "a.tpk") << "half";
  EXPECT_EQ(build({}).find("left it"), std::string::npos);
  EXPECT_EQ(cached(), 5u);
  EXPECT_FALSE(std::filesystem::exists(left));
  const std::string said = build({"--cache-limit", "1M", "--build", "--keep none"});
  EXPECT_NE(said.find("1 pack of 400,000 bytes left it"), std::string::npos) << said;
  EXPECT_FALSE(std::filesystem::exists(oldest));
  EXPECT_TRUE(std::filesystem::exists(older) && std::filesystem::exists(old) &&
              std::filesystem::exists(other));
}

TEST_F(LimitedCache, keeps_what_is_in_use_or_looked_at_and_what_it_has_just_built) {
  const auto shown = entry("a", 2'000'000, 3), looked_at = entry("b", 2'000'000, 2),
             free = entry("c", 2'000'000, 1);
  const int pack = ::open((shown / "a.tpk").c_str(), O_RDONLY | O_CLOEXEC),
            lock = ::open((looked_at / "lock").c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_EQ(::flock(pack, LOCK_SH), 0);
  ASSERT_EQ(::flock(lock, LOCK_EX), 0);
  build({"--cache-limit", "1M"});
  EXPECT_TRUE(std::filesystem::exists(shown / "a.tpk"));
  EXPECT_TRUE(std::filesystem::exists(looked_at / "b.tpk"));
  EXPECT_FALSE(std::filesystem::exists(free));
  EXPECT_EQ(cached(), 3u);
  ::close(pack);
  ::close(lock);
}

TEST_F(LimitedCache, keeps_the_pack_of_a_session_that_runs) {
  Program session({"session", model, "--path", path, "--until-told", "--size", "64x64", "--device", "cpu",
                   "-o", folder.file("p")});
  for (int tries = 0; tries < 6000 && picture("p").empty(); ++tries)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ASSERT_FALSE(picture("p").empty()) << session.errors();
  const auto pack = std::filesystem::directory_iterator(folder.file("cache"))->path() / "box.tpk";
  std::filesystem::last_write_time(
      pack.parent_path() / "lock",
      std::filesystem::file_time_type::clock::now() - std::chrono::hours(24 * 61));
  build({"--cache-limit", "1M", "--build", "--keep none"});
  EXPECT_TRUE(std::filesystem::exists(pack));
  session.signal(SIGKILL);
  session.wait();
  build({"--cache-limit", "1M", "--build", "--keep cover"});
  EXPECT_FALSE(std::filesystem::exists(pack));
}

TEST_F(LimitedCache, has_its_limit_from_a_file_of_defaults_also_where_a_build_has_no_cache) {
  const Variable config("TRIPTYCH_CONFIG", folder.file("triptych.toml"));
  std::ofstream(folder.file("triptych.toml")) << "cache-limit = '1M'\n";
  const auto oldest = entry("c", 2'000'000, 3);
  build({});
  EXPECT_FALSE(std::filesystem::exists(oldest));
  run({"build", model, "-o", folder.file("box.tpk")});
  Program alone({"build", model, "-o", folder.file("box.tpk"), "--cache-limit", "1M"});
  EXPECT_EQ(alone.wait(), 2);
}

TEST_F(ShownModel, that_cannot_be_read_gives_the_errors_of_a_build_and_leaves_no_pack) {
  std::ofstream(folder.file("none.obj")) << "# nothing\n";
  EXPECT_NE(failure({"info", folder.file("none.obj")}).find("none.obj"), std::string::npos);
  for (const auto& file : std::filesystem::recursive_directory_iterator(folder.file("cache")))
    EXPECT_NE(file.path().extension(), ".tpk");
}

TEST_F(ShownModel, is_none_of_the_outputs) {
  const std::string said = failure({"info", model, "--json", folder.file("box.mtl")});
  EXPECT_NE(said.find("box.mtl: is a file of the model"), std::string::npos) << said;
}

TEST_F(ShownModel, and_packs_are_not_mixed_and_packs_are_not_built_of) {
  run({"build", model, "-o", folder.file("box.tpk")});
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"info", model, folder.file("box.tpk")},
        {"info", folder.file("box.tpk"), "--build", "--keep none"},
        {"info", model, "--build", "--keep nonsense"},
        {"info", model, "--build", "other.obj"}}) {
    Program program(words);
    EXPECT_EQ(program.wait(), 2) << words.back() << ": " << program.errors();
  }
  const std::string said = failure({"build", folder.file("box.tpk"), "-o", folder.file("again.tpk")});
  EXPECT_NE(said.find("is a pack already: `triptych view` shows it"), std::string::npos) << said;
}

TEST_F(ShownModel, with_transparent_materials_says_so) {
  const std::string json = folder.file("info.json");
  run({"info", model, "--json", json});
  EXPECT_EQ(json_of(json)["effects"].size(), 0u);
  write_model(folder.file("."), "1 0 0", "d 0.5\n");
  run({"info", model, "--json", json});
  EXPECT_EQ(json_of(json)["effects"], nlohmann::json({"transparency"}));
  EXPECT_EQ(json_of(json)["build"]["transparent-materials"], "1");
}

TEST_F(ShownModel, is_checked_quickly_by_its_bytes_alone) {
  const std::string pack = folder.file("box.tpk"), json = folder.file("check.json");
  run({"build", model, "-o", pack});
  run({"check", pack, "--quick", "--json", json});
  EXPECT_EQ(json_of(json)["checksum_errors"], 0);
  EXPECT_GT(json_of(json)["checked_bytes"].get<size_t>(), 100u);
  std::string bytes = text_of(pack);
  bytes[40] = static_cast<char>(bytes[40] ^ 1);  // in the first chunk
  std::ofstream(pack, std::ios::binary) << bytes;
  const std::string said = failure({"check", pack, "--quick", "--json", json});
  EXPECT_NE(said.find("section GEOM: chunk 0: byte "), std::string::npos) << said;
  EXPECT_EQ(json_of(json)["checksum_errors"], 1);
}

}  // namespace
}  // namespace triptych::test
