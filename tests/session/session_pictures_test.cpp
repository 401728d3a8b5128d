// Three processes, one picture: the one that a single process draws without culling anything.
#include "tests/session/scene_files.hpp"

#include <cstdlib>

namespace triptych::test {
namespace {

class SessionPictures : public SceneFiles {
 protected:
  void expect_identical(size_t frames) const {
    const nlohmann::json report = json_of(json);
    EXPECT_EQ(report["frames"], frames);
    EXPECT_EQ(report["frames_compared"], frames);
    EXPECT_EQ(report["identical_frames"], frames);
    EXPECT_EQ(report["digest_mismatches"], 0);
    EXPECT_EQ(report["fallback_frames"], 0);
    EXPECT_EQ(report["missing_drawables"], 0);
    EXPECT_EQ(report["raster"], nlohmann::json({"exact", "exact", "exact"}));
  }
  /// Of a session whose roles are started one by one, beside those that a single process draws un-culled.
  void expect_identical_of_roles_started_by_hand(const std::string& library_of_switch_1 = {}) const {
    // Ports of this process's own choice, below those that the kernel hands out.
    const int port = 12000 + 2 * (::getpid() % 8000);
    const std::string render = "127.0.0.1:" + std::to_string(port),
                      other = "127.0.0.1:" + std::to_string(port + 1);
    if (!library_of_switch_1.empty()) ::setenv("GLIBC_TUNABLES", library_of_switch_1.c_str(), 1);
    Program switch_1({"role", "switch", pack, "--index", "1", "--render", render, "--switch-0", other});
    ::unsetenv("GLIBC_TUNABLES");
    Program switch_0({"role", "switch", pack, "--index", "0", "--listen", other, "--render", render});
    Program render_node({"role", "render", pack, "--path", path, "--size", "160x120", "--frames", "6",
                         "--listen", render, "--gather", "60", "-o", folder.file("roles")});
    EXPECT_EQ(render_node.wait(), 0) << render_node.errors();
    EXPECT_EQ(switch_0.wait(), 0) << switch_0.errors();
    EXPECT_EQ(switch_1.wait(), 0) << switch_1.errors();
    run({"render", pack, "--path", path, "--size", "160x120", "--frames", "6", "--cull", "frustum", "-o",
         folder.file("render")});
    for (int frame = 0; frame < 6; ++frame) {
      const std::string name = "/00000" + std::to_string(frame) + ".png";
      EXPECT_EQ(text_of(folder.file("roles") + name), text_of(folder.file("render") + name))
          << "frame " << frame;
    }
  }
};

TEST_F(SessionPictures, are_the_un_culled_ones_through_turns_and_jumps) {
  run(measure());
  expect_identical(frame_count);
}

TEST_F(SessionPictures, are_the_un_culled_ones_with_osmesa_queries_and_an_odd_size) {
  run(measure({"--context", "osmesa", "--test", "queries", "--pixel-error", "4"}, "211x97"));
  expect_identical(frame_count);
}

TEST_F(SessionPictures, are_the_un_culled_ones_through_portals) {
  run(measure({"--cull", "portals", "--frames", "12"}));
  expect_identical(12);
}

TEST_F(SessionPictures, are_the_un_culled_ones_with_samples_and_edges) {
  run(measure({"--samples", "4", "--edges", "--frames", "12"}));
  expect_identical(12);
  EXPECT_EQ(json_of(json)["samples"], 4);
  EXPECT_EQ(json_of(json)["edges"], true);
}

TEST_F(SessionPictures, are_the_un_culled_ones_each_time_that_the_path_is_played) {
  run(measure({"--frames", "6", "--loop", "3"}));
  expect_identical(18);
}

TEST_F(SessionPictures, and_visible_sets_are_the_same_every_time) {
  run(measure({"--frames", "20"}));
  const nlohmann::json once = json_of(json);
  run(measure({"--frames", "20", "--rate", "30"}));
  const nlohmann::json again = json_of(json);
  for (const char* key : {"visible", "tests", "drawn_triangles", "identical_frames"})
    EXPECT_EQ(once[key], again[key]) << key;
}

TEST_F(SessionPictures, are_the_files_that_one_process_writes) {
  run(session({"--frames", "6", "-o", folder.file("session")}));
  run({"render", pack, "--path", path, "--size", "160x120", "--frames", "6", "-o", folder.file("render")});
  run({"session", pack, "--path", path, "--size", "160x120", "--frames", "6", "--context", "egl", "-o",
       folder.file("egl")});
  run({"render", pack, "--path", path, "--size", "160x120", "--frames", "6", "--context", "osmesa", "-o",
       folder.file("osmesa")});
  for (int frame = 0; frame < 6; ++frame) {
    const std::string name = "/00000" + std::to_string(frame) + ".png";
    const std::string picture = text_of(folder.file("session") + name);
    EXPECT_GT(picture.size(), 100u);
    EXPECT_TRUE(picture == text_of(folder.file("render") + name)) << "frame " << frame;
    // OpenGL's are alike in both contexts, and need not be the rasteriser's.
    EXPECT_TRUE(text_of(folder.file("egl") + name) == text_of(folder.file("osmesa") + name))
        << "frame " << frame;
  }
}

TEST_F(SessionPictures, are_the_same_of_roles_that_are_started_by_hand) {
  expect_identical_of_roles_started_by_hand();
}

TEST_F(SessionPictures, are_the_same_where_a_role_runs_on_a_processor_without_fused_multiply_add) {
  // The C library's tangents, sines and powers differ there.
  expect_identical_of_roles_started_by_hand("glibc.cpu.hwcaps=-AVX2,-FMA");
}

/// A picture's size, and on `gl` where OpenGL comes from.
class BuildingPictures : public SessionPictures,
                         public testing::WithParamInterface<std::pair<const char*, const char*>> {};

TEST_P(BuildingPictures, are_the_un_culled_ones_on_every_frame_of_every_path) {
  if (!std::filesystem::exists("/usr/share/sweethome3d")) {
    GTEST_SKIP() << "the furniture is not installed";
  }
  const auto [size, context] = GetParam();
  const char* device = std::getenv("TRIPTYCH_DEVICE");
  const bool on_gl = device && device == std::string("gl");
  const std::string building = folder.file("building"), building_pack = folder.file("building.tpk");
  run({"sample", "building", "--floors", "1", "--furniture", "200", "-o", building});
  run({"build", building + "/scene.gltf", "-o", building_pack});
  for (const std::string name : {"walk", "fly", "spin", "jump"}) {
    SCOPED_TRACE(name);
    const std::string file = building + "/" + name + ".json";
    run({"measure", "session", building_pack, "--path", file, "--size", size,
         on_gl ? "--context" : "--device", on_gl ? context : "cpu", "--timeout", "60000", "--json", json});
    const nlohmann::json report = json_of(json);
    expect_identical(json_of(file)["frames"].size());
    EXPECT_EQ(report["one_process"]["identical_frames"], report["frames"]);
    if (name == "walk") {
      EXPECT_GE(report["delta"]["saved_percent"].get<double>(), 93);
      EXPECT_LE(report["culling_efficiency"].get<double>(), 3);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, BuildingPictures,
                         testing::Values(std::pair("512x512", "egl"), std::pair("641x479", "osmesa")),
                         [](const auto& parameter) { return "of_" + std::string(parameter.param.first); });

}  // namespace
}  // namespace triptych::test
