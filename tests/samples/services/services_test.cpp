// The hospital full of services as a whole: how many objects of how few meshes, and that its walk is free.
#include "samples/services/services.hpp"

#include "base/error.hpp"
#include "base/file.hpp"
#include "samples/camera_paths.hpp"
#include "samples/services/hospital_plan.hpp"
#include "tests/samples/sample_files.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>

namespace triptych {
namespace {

using Json = nlohmann::json;

/// Two storeys, made and read once; the walk is on the upper one, which has no ceilings.
struct Hospital {
  Folder folder{"hospital"};
  ServicesReport report = make_services({2, 1}, folder.path());
  Json gltf = Json::parse(read_text_file(folder.path() / "scene.gltf"));
  Model model = read_whole(folder.path() / "scene.gltf");
};

const Hospital& hospital_of_two() {
  static const Hospital made;
  return made;
}

struct View {
  glm::dvec3 eye, target;
};

std::vector<View> path(const std::string& name) {
  std::vector<View> views;
  const auto point = [](const Json& numbers) { return glm::dvec3(numbers[0], numbers[1], numbers[2]); };
  const Json json = Json::parse(read_text_file(hospital_of_two().folder.path() / name));
  for (const Json& frame : json["frames"]) views.push_back({point(frame["eye"]), point(frame["target"])});
  return views;
}

TEST(Services, each_object_is_one_flat_node_of_a_shared_mesh_and_the_report_counts_them) {
  const auto& [folder, report, gltf, model] = hospital_of_two();
  EXPECT_EQ(gltf["nodes"].size(), report.objects);
  EXPECT_EQ(gltf["scenes"][0]["nodes"].size(), report.objects) << "all at the top";
  EXPECT_EQ(gltf["meshes"].size(), report.meshes);
  for (const Json& node : gltf["nodes"]) {
    ASSERT_TRUE(node.contains("mesh"));
    EXPECT_FALSE(node["name"].get<std::string>().empty());
  }
  EXPECT_TRUE(model.groups.empty());
  EXPECT_EQ(model.source_triangles(), report.unique_triangles);
  EXPECT_EQ(model.placed_triangles(), report.placed_triangles);
  EXPECT_EQ(model.report.dropped_triangles, 0u);
}

TEST(Services, a_storey_has_ten_thousand_objects_of_twenty_to_some_hundred_triangles) {
  const ServicesReport& report = hospital_of_two().report;
  EXPECT_NEAR(double(report.objects) / 2, 10'000, 1'500);
  EXPECT_GE(report.placed_triangles, report.objects * 160);
  EXPECT_GE(report.triangles_per_object.p5, 20u);
  EXPECT_LE(report.triangles_per_object.p95, 500u);
  EXPECT_LE(report.triangles_per_object.max, 800u);
}

TEST(Services, a_few_meshes_stand_for_most_objects_and_many_are_used_once) {
  const auto& [folder, report, gltf, model] = hospital_of_two();
  std::vector<uint64_t> uses(model.meshes.size(), 0);
  for (const Instance& instance : model.instances) ++uses[instance.mesh];
  std::sort(uses.rbegin(), uses.rend());
  EXPECT_EQ(uses.front(), report.uses_per_mesh.max);
  EXPECT_GT(uses.front(), 300u);
  EXPECT_LE(report.uses_per_mesh.p50, 4u);
  EXPECT_EQ(size_t(std::count(uses.begin(), uses.end(), 1u)), report.unshared_meshes);
  EXPECT_GT(report.unshared_meshes * 4, report.meshes);
  uint64_t of_most_used = 0;
  for (size_t i = 0; i < uses.size() / 10; ++i) of_most_used += uses[i];
  EXPECT_GT(of_most_used * 2, report.objects) << "a tenth of the meshes";
}

TEST(Services, a_seed_decides_everything) {
  const Folder one("one"), same("same"), other("other");
  make_services({1, 5}, one.path());
  make_services({1, 5}, same.path());
  make_services({1, 6}, other.path());
  for (const char* file :
       {"scene.gltf", "scene.bin", "walk.json", "fly.json", "spin.json", "jump.json", "orbit.json"})
    EXPECT_EQ(read_file(one.path() / file), read_file(same.path() / file)) << file;
  EXPECT_NE(read_file(one.path() / "scene.gltf"), read_file(other.path() / "scene.gltf"));
}

TEST(Services, a_number_of_storeys_out_of_range_is_an_error) {
  EXPECT_THROW(make_services({0, 1}, "nowhere"), Error);
  EXPECT_THROW(make_services({max_services_storeys + 1, 1}, "nowhere"), Error);
  EXPECT_FALSE(std::filesystem::exists("nowhere"));
}

TEST(Services, every_seed_has_a_walk) {
  for (const uint64_t seed : {2, 3, 4}) {
    const Folder folder("seeds");
    EXPECT_NO_THROW(make_services({1, seed}, folder.path())) << seed;
  }
}

TEST(Services, rooms_of_a_storey_do_not_overlap_and_shafts_stand_above_each_other) {
  const auto below = plan_storey(0, Random(3)), above = plan_storey(1, Random(4));
  const auto shafts = [](const std::vector<HospitalRoom>& rooms) {
    std::set<std::pair<double, double>> places;
    for (const HospitalRoom& room : rooms)
      if (room.use == RoomUse::shaft) places.insert({room.grid.x0, room.grid.z0});
    return places;
  };
  EXPECT_EQ(shafts(below), shafts(above));
  EXPECT_EQ(shafts(below).size(), 4u);
  for (size_t i = 0; i < below.size(); ++i)
    for (size_t k = i + 1; k < below.size(); ++k)
      EXPECT_FALSE(below[i].grid.overlaps(below[k].grid)) << below[i].name << " and " << below[k].name;
}

TEST(ServicesWalk, moves_and_turns_as_people_do_on_the_storey_without_ceilings) {
  const auto walk = path("walk.json");
  ASSERT_EQ(walk.size(), 600u);
  for (size_t i = 1; i < walk.size(); ++i) {
    EXPECT_NEAR(glm::distance(walk[i].eye, walk[i - 1].eye), walking_step, 0.01);
    const glm::dvec3 a = glm::normalize(walk[i - 1].target - walk[i - 1].eye),
                     b = glm::normalize(walk[i].target - walk[i].eye);
    EXPECT_LT(std::acos(std::min(1.0, glm::dot(a, b))), glm::radians(1.0)) << "frame " << i;
    EXPECT_NEAR(walk[i].eye.y, hospital::storey + eye_height, 1e-6);
  }
}

TEST(ServicesWalk, passes_through_no_wall_no_duct_and_no_furniture_and_has_a_floor_under_it) {
  const auto walk = path("walk.json");
  const Model& model = hospital_of_two().model;
  constexpr size_t every = 5;
  constexpr double reach = 0.25;
  ASSERT_FALSE(walk.empty());
  std::vector<bool> floor(walk.size(), false);
  for (const Instance& instance : model.instances) {
    const Mesh& mesh = model.meshes[instance.mesh];
    std::vector<glm::dvec3> placed;
    glm::dvec3 box_low(HUGE_VAL), box_high(-HUGE_VAL);
    for (const glm::dvec3& position : mesh.positions) {
      placed.push_back(instance.transform * glm::dvec4(position, 1));
      box_low = glm::min(box_low, placed.back());
      box_high = glm::max(box_high, placed.back());
    }
    for (size_t i = 0; i < walk.size(); i += every) {
      const glm::dvec3 low = walk[i].eye - glm::dvec3(reach, eye_height + 0.01, reach),
                       high = walk[i].eye + glm::dvec3(reach, 0.25, reach);
      const auto meets = [&](const glm::dvec3& a, const glm::dvec3& b) {
        return glm::all(glm::lessThan(a, high)) && glm::all(glm::lessThan(low, b));
      };
      if (!meets(box_low, box_high)) continue;
      for (const Triangle& triangle : mesh.triangles) {
        const glm::dvec3 &a = placed[triangle.vertices[0]], &b = placed[triangle.vertices[1]],
                         &c = placed[triangle.vertices[2]];
        const glm::dvec3 from = glm::min(a, glm::min(b, c)), to = glm::max(a, glm::max(b, c));
        if (!meets(from, to)) continue;
        if (to.y < low.y + 0.07) {
          floor[i] = true;
        } else {
          ADD_FAILURE() << mesh.name << " at frame " << i;
          return;
        }
      }
    }
  }
  for (size_t i = 0; i < walk.size(); i += every) EXPECT_TRUE(floor[i]) << "frame " << i;
}

TEST(ServicesPaths, have_their_lengths_and_the_orbit_stays_outside) {
  EXPECT_EQ(path("fly.json").size(), 300u);
  EXPECT_EQ(path("spin.json").size(), 120u);
  EXPECT_EQ(path("jump.json").size(), 60u);
  const auto orbit = path("orbit.json");
  ASSERT_EQ(orbit.size(), 300u);
  const glm::dvec3 middle(hospital::width / 2, 0, hospital::depth / 2);
  for (const View& view : orbit)
    EXPECT_GT(glm::distance(glm::dvec2(view.eye.x, view.eye.z), glm::dvec2(middle.x, middle.z)), 32);
}

}  // namespace
}  // namespace triptych
