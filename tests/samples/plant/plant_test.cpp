// The power plant as a whole: how much there is, how unlike its objects are, and that its walk is free.
#include "samples/plant/plant.hpp"

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/threads.hpp"
#include "tests/samples/sample_files.hpp"

#include <algorithm>
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

namespace triptych {
namespace {

PlantOptions plant_of(uint64_t triangles, uint64_t seed = 1) { return {triangles, seed}; }

TEST(Plant, it_has_as_many_triangles_as_were_asked_for_in_about_1200_objects) {
  for (const uint64_t wanted : {50'000u, 130'000u, 700'000u}) {
    const Folder folder("count");
    const PlantReport report = make_plant(plant_of(wanted), folder.path());
    const Model model = read_whole(folder.path() / "scene.gltf");
    EXPECT_EQ(model.source_triangles(), report.triangles);
    EXPECT_NEAR(double(report.triangles), double(wanted), 0.02 * double(wanted));
    EXPECT_EQ(model.meshes.size(), report.objects);
    EXPECT_EQ(model.instances.size(), report.objects) << "not instanced";
    EXPECT_NEAR(double(report.objects), 1200, 60);
    EXPECT_EQ(model.report.dropped_triangles, 0u);
  }
}

TEST(Plant, one_network_of_pipes_is_half_of_it_and_bolts_have_20_triangles) {
  const Folder folder("spread");
  const PlantReport report = make_plant(plant_of(1'000'000), folder.path());
  EXPECT_NEAR(double(report.largest_object), 0.5 * 1'000'000, 60'000);
  EXPECT_LE(report.smallest_object, 20u);
  const Model model = read_whole(folder.path() / "scene.gltf");
  std::vector<size_t> sizes;
  size_t bolts = 0;
  for (const Mesh& mesh : model.meshes) {
    sizes.push_back(mesh.triangles.size());
    bolts += mesh.name == "bolt" && mesh.triangles.size() == 20;
  }
  EXPECT_GE(bolts, 40u);
  std::sort(sizes.rbegin(), sizes.rend());
  EXPECT_EQ(sizes[0], report.largest_object);
  EXPECT_GT(sizes[1], sizes[sizes.size() / 2] * 50) << "some are large";
}

TEST(Plant, a_seed_decides_everything_whatever_the_threads) {
  const Folder one("one"), same("same"), other("other");
  make_plant(plant_of(60'000, 5), one.path());
  set_thread_count(1);
  make_plant(plant_of(60'000, 5), same.path());
  set_thread_count(0);
  make_plant(plant_of(60'000, 6), other.path());
  for (const char* file : {"scene.gltf", "scene.bin", "walk.json", "fly.json", "spin.json", "jump.json"})
    EXPECT_EQ(read_file(one.path() / file), read_file(same.path() / file)) << file;
  EXPECT_NE(read_file(one.path() / "scene.bin"), read_file(other.path() / "scene.bin"));
}

TEST(Plant, a_number_of_triangles_out_of_range_is_an_error) {
  EXPECT_THROW(make_plant(plant_of(1000), "nowhere"), Error);
  EXPECT_THROW(make_plant(plant_of(60'000'000), "nowhere"), Error);
  EXPECT_FALSE(std::filesystem::exists("nowhere"));
}

TEST(Plant, the_walk_is_a_walk) {
  const CameraFrames walk = plant_walk();
  ASSERT_EQ(walk.size(), 300u);
  double turned = 0;
  for (size_t i = 1; i < walk.size(); ++i) {
    EXPECT_NEAR(glm::distance(walk[i].eye, walk[i - 1].eye), walking_step, 0.001);
    const glm::dvec3 a = glm::normalize(walk[i - 1].target - walk[i - 1].eye),
                     b = glm::normalize(walk[i].target - walk[i].eye);
    const double turn = glm::degrees(std::acos(std::min(1.0, glm::dot(a, b))));
    EXPECT_LE(turn, 1.0);
    turned += turn;
  }
  EXPECT_NEAR(turned, 90, 1) << "around a corner";
}

TEST(Plant, nothing_stands_in_the_walks_way_and_a_floor_is_under_it) {
  const Folder folder("way");
  make_plant(plant_of(300'000), folder.path());
  const Model model = read_whole(folder.path() / "scene.gltf");
  const CameraFrames walk = plant_walk();
  std::vector<bool> floor(walk.size(), false);
  for (const Mesh& mesh : model.meshes) {
    for (const Triangle& triangle : mesh.triangles) {
      const glm::dvec3 &a = mesh.positions[triangle.vertices[0]], &b = mesh.positions[triangle.vertices[1]],
                       &c = mesh.positions[triangle.vertices[2]];
      const glm::dvec3 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
      for (size_t i = 0; i < walk.size(); i += 10) {
        const glm::dvec3 body = walk[i].eye, reach(0.35, 0, 0.35);
        const bool beside = high.x < body.x - reach.x || low.x > body.x + reach.x ||
                            high.z < body.z - reach.z || low.z > body.z + reach.z;
        if (beside) continue;
        EXPECT_FALSE(high.y > body.y - 1.5 && low.y < body.y + 0.2) << mesh.name << " at frame " << i;
        if (high.y <= body.y - 1.5 && high.y > body.y - 1.75) floor[i] = true;
      }
    }
  }
  for (size_t i = 0; i < walk.size(); i += 10) EXPECT_TRUE(floor[i]) << "frame " << i;
}

TEST(Plant, all_paths_stay_inside) {
  const Folder folder("inside");
  make_plant(plant_of(50'000), folder.path());
  const Model model = read_whole(folder.path() / "scene.gltf");
  glm::dvec3 low(HUGE_VAL), high(-HUGE_VAL);
  for (const Mesh& mesh : model.meshes) {
    for (const auto& position : mesh.positions) {
      low = glm::min(low, position);
      high = glm::max(high, position);
    }
  }
  const CameraFrames fly = plant_fly(), spin = plant_spin(), jump = plant_jump(Random(1));
  EXPECT_EQ(fly.size(), 300u);
  EXPECT_EQ(spin.size(), 120u);
  EXPECT_EQ(jump.size(), 60u);
  for (const auto& path : {plant_walk(), fly, spin, jump}) {
    for (const CameraFrame& frame : path) {
      EXPECT_TRUE(glm::all(glm::lessThan(low, frame.eye)) && glm::all(glm::lessThan(frame.eye, high)));
      EXPECT_GT(glm::distance(frame.eye, frame.target), 0.1);
    }
  }
}

}  // namespace
}  // namespace triptych
