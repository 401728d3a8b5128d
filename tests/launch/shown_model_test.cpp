// Model files where a pack is shown: built once, and again where anything about them is another.
#include "tests/launch/model_files.hpp"

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
  EXPECT_EQ(json_of(json)["build"]["keep"], "cover,order,planes,touching");
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
  EXPECT_EQ(json_of(json)["effects"], nlohmann::json({"transparent materials"}));
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
