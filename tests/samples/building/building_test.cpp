// A small building as a whole: what it holds, that it is sound, and that a seed decides it.
#include "samples/building/building.hpp"

#include "base/error.hpp"
#include "base/file.hpp"
#include "samples/building/obstacles.hpp"
#include "samples/building/storeys.hpp"

#include <cstring>
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>

namespace triptych {
namespace {

BuildingOptions tiny(uint64_t seed = 1) {
  BuildingOptions options;
  options.floors = 1;
  options.furniture = 200;
  options.seed = seed;
  return options;
}

const BuildingDesign& design() {
  static const BuildingDesign made = [] {
    BuildingOptions options;
    options.floors = 2;
    options.furniture = 1500;
    options.seed = 3;
    return design_building(options);
  }();
  return made;
}

class Folder {
 public:
  explicit Folder(const std::string& name)
      : path_(std::filesystem::temp_directory_path() /
              ("triptych_samples_" + name + "_" + std::to_string(getpid()))) {}
  ~Folder() { std::filesystem::remove_all(path_); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

double distance_to(const Rect& rect, glm::dvec2 at) {
  return glm::length(
      glm::max(glm::max(glm::dvec2(rect.x0, rect.z0) - at, at - glm::dvec2(rect.x1, rect.z1)), 0.0));
}

TEST(Building, a_tiny_building_holds_what_was_asked_for_of_few_models) {
  const Folder folder("tiny");
  const SampleReport report = make_building(tiny(), folder.path());
  EXPECT_EQ(report.placements, 200u);
  EXPECT_LT(report.unique_triangles, 300'000u);
  EXPECT_GT(report.placed_triangles, report.unique_triangles);
  EXPECT_TRUE(report.skipped_models.empty());

  const auto gltf = nlohmann::json::parse(read_text_file(folder.path() / "scene.gltf"));
  EXPECT_EQ(gltf["asset"]["version"], "2.0");
  EXPECT_EQ(gltf["asset"]["generator"], "triptych sample building");
  EXPECT_EQ(gltf["asset"]["extras"]["models"].size(), report.furniture_meshes);
  EXPECT_EQ(gltf["nodes"].size(), report.placements + report.shell_placements);
  EXPECT_EQ(gltf["meshes"].size(), report.furniture_meshes + report.shell_meshes);
  for (const char* file : {"walk.json", "fly.json", "spin.json", "jump.json", "ATTRIBUTION.txt"})
    EXPECT_TRUE(std::filesystem::exists(folder.path() / file)) << file;
}

TEST(Building, accessors_lie_in_the_buffer_and_tell_the_truth) {
  const Folder folder("accessors");
  const SampleReport report = make_building(tiny(), folder.path());
  const auto gltf = nlohmann::json::parse(read_text_file(folder.path() / "scene.gltf"));
  const auto buffer = read_file(folder.path() / "scene.bin");
  ASSERT_EQ(gltf["buffers"][0]["byteLength"], buffer.size());
  const auto values = [&]<typename Value>(size_t accessor, size_t components, Value) {
    const auto& view = gltf["bufferViews"][gltf["accessors"][accessor]["bufferView"].get<size_t>()];
    const size_t offset = view["byteOffset"], bytes = view["byteLength"];
    std::vector<Value> result(gltf["accessors"][accessor]["count"].get<size_t>() * components);
    EXPECT_EQ(bytes, result.size() * sizeof(Value));
    EXPECT_EQ(offset % 4, 0u);
    if (offset + bytes <= buffer.size()) std::memcpy(result.data(), buffer.data() + offset, bytes);
    return result;
  };
  uint64_t triangles = 0;
  for (const auto& mesh : gltf["meshes"]) {
    for (const auto& primitive : mesh["primitives"]) {
      const size_t position = primitive["attributes"]["POSITION"];
      const auto positions = values(position, 3, float{});
      const auto indices = values(primitive["indices"].get<size_t>(), 1, uint32_t{});
      triangles += indices.size() / 3;
      for (const uint32_t index : indices) ASSERT_LT(index, positions.size() / 3);
      for (size_t axis = 0; axis < 3; ++axis) {
        float low = positions[axis], high = low;
        for (size_t i = axis; i < positions.size(); i += 3)
          low = std::min(low, positions[i]), high = std::max(high, positions[i]);
        EXPECT_EQ(gltf["accessors"][position]["min"][axis].get<float>(), low);
        EXPECT_EQ(gltf["accessors"][position]["max"][axis].get<float>(), high);
      }
    }
  }
  EXPECT_EQ(triangles, report.unique_triangles);
}

TEST(Building, equal_options_give_equal_bytes_and_another_seed_another_building) {
  const Folder first("first"), second("second"), other("other");
  make_building(tiny(), first.path());
  make_building(tiny(), second.path());
  make_building(tiny(2), other.path());
  for (const char* file :
       {"scene.gltf", "scene.bin", "walk.json", "fly.json", "spin.json", "jump.json", "ATTRIBUTION.txt"})
    EXPECT_EQ(read_file(first.path() / file), read_file(second.path() / file)) << file;
  EXPECT_NE(read_file(first.path() / "scene.gltf"), read_file(other.path() / "scene.gltf"));
}

TEST(Building, every_placement_is_inside_its_room_and_overlaps_no_other) {
  const auto& placements = design().furnishing.placements;
  ASSERT_EQ(placements.size(), 1500u);
  for (size_t i = 0; i < placements.size(); ++i) {
    const Room& room = design().plan.rooms[static_cast<size_t>(placements[i].room)];
    EXPECT_TRUE(room.area.contains(placements[i].footprint));
    EXPECT_GE(placements[i].position.y, floor_level(room.floor));
    EXPECT_LE(placements[i].top, measures::ceiling + 1e-6);
    for (const Rect& hole : room.voids) EXPECT_FALSE(hole.overlaps(placements[i].footprint));
    for (size_t k = i + 1; k < placements.size() && placements[k].room == placements[i].room; ++k) {
      // Things on a desk that has a hutch are within its box.
      const FurniturePlacement &a = placements[i], &b = placements[k];
      const bool on_top = b.bottom > a.bottom + 0.01;
      const bool side_by_side = !on_top && a.bottom < b.top - 1e-5 && a.top > b.bottom + 1e-5;
      EXPECT_FALSE(side_by_side && a.footprint.overlaps(b.footprint.grown(-1e-5)));
    }
  }
}

TEST(Building, doors_can_be_walked_through) {
  for (const Wall& wall : design().plan.walls) {
    for (const Opening& opening : wall.openings) {
      if (opening.kind == OpeningKind::window || !wall.along_x) continue;
      const Rect way{opening.from, wall.footprint.z0 - 0.5, opening.to, wall.footprint.z1 + 0.5};
      for (const FurniturePlacement& placement : design().furnishing.placements) {
        const int room = placement.room;
        const bool near = (room == wall.low_room || room == wall.high_room) && placement.bottom < 1.9;
        EXPECT_FALSE(near && way.overlaps(placement.footprint));
      }
    }
  }
}

TEST(Walk, keeps_clear_of_walls_and_furniture_and_moves_and_turns_as_people_do) {
  const CameraFrames& walk = design().walk;
  ASSERT_EQ(walk.size(), 300u);
  const int floor = design().plan.floors / 2;
  const auto in_the_way = obstacles(design().plan, design().furnishing.placements, floor);
  EXPECT_GT(in_the_way.size(), 100u);
  for (size_t i = 0; i < walk.size(); ++i) {
    const glm::dvec2 at(walk[i].eye.x, walk[i].eye.z);
    EXPECT_DOUBLE_EQ(walk[i].eye.y, floor_level(floor) + eye_height);
    for (const Rect& rect : in_the_way) ASSERT_GE(distance_to(rect, at), walking_clearance) << "frame " << i;
    if (i == 0) continue;
    EXPECT_NEAR(glm::distance(walk[i].eye, walk[i - 1].eye), walking_step, 0.01);
    const glm::dvec3 before = glm::normalize(walk[i - 1].target - walk[i - 1].eye),
                     now = glm::normalize(walk[i].target - walk[i].eye);
    EXPECT_LT(std::acos(std::min(1.0, glm::dot(before, now))), glm::radians(1.0)) << "frame " << i;
  }
}

TEST(Walk, leads_through_at_least_two_rooms_besides_corridors) {
  std::set<size_t> seen;
  for (const CameraFrame& frame : design().walk)
    for (size_t i = 0; i < design().plan.rooms.size(); ++i)
      if (distance_to(design().plan.rooms[i].area, {frame.eye.x, frame.eye.z}) <= 0 &&
          design().plan.rooms[i].floor == design().plan.floors / 2)
        seen.insert(i);
  EXPECT_GE(seen.size(), 3u);
}

TEST(Paths, have_their_lengths_and_paces) {
  EXPECT_EQ(design().fly.size(), 300u);
  EXPECT_EQ(design().spin.size(), 120u);
  EXPECT_EQ(design().jump.size(), 60u);
  for (size_t i = 1; i < 300; ++i)
    EXPECT_NEAR(glm::distance(design().fly[i].eye, design().fly[i - 1].eye), 1.0, 0.4) << i;
  for (const CameraFrame& frame : design().spin) EXPECT_EQ(frame.eye, design().spin[0].eye);
}

TEST(Building, repeated_storeys_are_nodes_with_equal_children_and_stand_on_each_other) {
  const Folder folder("tower");
  BuildingOptions options;
  options.floors = 6;
  options.furniture = 1200;
  options.repeat_storeys = 2;
  const SampleReport report = make_building(options, folder.path());
  EXPECT_EQ(report.different_storeys, 4);
  const auto gltf = nlohmann::json::parse(read_text_file(folder.path() / "scene.gltf"));
  std::vector<nlohmann::json> storeys;
  size_t placements = 0;
  for (const size_t root : gltf["scenes"][0]["nodes"]) {
    const auto& node = gltf["nodes"][root];
    if (!node.contains("children")) {
      ++placements;
      continue;
    }
    EXPECT_EQ(node["name"], "storey " + std::to_string(storeys.size()));
    storeys.push_back(nlohmann::json::array({node["translation"]}));
    for (const size_t child : node["children"]) {
      storeys.back().push_back(gltf["nodes"][child]);
      ++placements;
    }
  }
  EXPECT_EQ(placements, report.placements + report.shell_placements);
  ASSERT_EQ(storeys.size(), 6u);
  const auto without_place = [](nlohmann::json storey) {
    storey.erase(0);
    return storey;
  };
  EXPECT_EQ(without_place(storeys[1]), without_place(storeys[3]));
  EXPECT_EQ(without_place(storeys[2]), without_place(storeys[4]));
  EXPECT_NE(without_place(storeys[1]), without_place(storeys[2]));
  for (const size_t different : {0, 1, 2}) EXPECT_EQ(storeys[different][0][1], 0);
  EXPECT_EQ(storeys[3][0][1], floor_level(3) - floor_level(1));
  EXPECT_EQ(storeys[5][0][1], floor_level(5) - floor_level(3));
  // Rooms and furniture of the paths' building are those of the storeys, each where it stands.
  const BuildingDesign made = design_building(options);
  const FloorPlan tower = repeat_plan(made.plan, made.storeys);
  const auto all = repeat_placements(made.plan, made.furnishing.placements, made.storeys);
  EXPECT_EQ(tower.rooms.size(), report.rooms);
  EXPECT_EQ(all.size(), report.placements);
  for (const FurniturePlacement& placement : all) {
    const Room& room = tower.rooms[static_cast<size_t>(placement.room)];
    EXPECT_TRUE(room.area.contains(placement.footprint));
    EXPECT_GE(placement.position.y, floor_level(room.floor) - 1e-9);
    EXPECT_LT(placement.position.y, floor_level(room.floor + 1));
  }
}

TEST(Building, options_out_of_range_are_errors) {
  BuildingOptions options = tiny();
  options.floors = 0;
  EXPECT_THROW(design_building(options), Error);
  options.repeat_storeys = 1;
  EXPECT_THROW(design_building(options), Error);
  options.floors = 101;
  EXPECT_THROW(design_building(options), Error);
  options = tiny();
  options.repeat_storeys = 0;
  EXPECT_THROW(design_building(options), Error);
  options = tiny();
  options.furniture = -1;
  EXPECT_THROW(design_building(options), Error);
}

}  // namespace
}  // namespace triptych
