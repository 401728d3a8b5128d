// The building with effects: what it adds, that the rest of it stays, and that a seed decides it.
#include "samples/building/dressing.hpp"

#include "base/file.hpp"
#include "samples/building/building.hpp"
#include "samples/building/dressing_images.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace triptych {
namespace {

class Folder {
 public:
  explicit Folder(const std::string& name)
      : path_(std::filesystem::temp_directory_path() /
              ("triptych_dressing_" + name + "_" + std::to_string(getpid()))) {}
  ~Folder() { std::filesystem::remove_all(path_); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

BuildingOptions tiny(bool effects) {
  BuildingOptions options;
  options.floors = 1;
  options.furniture = 60;
  options.effects = effects;
  return options;
}

std::string text_of(const std::filesystem::path& file) {
  const std::vector<std::byte> bytes = read_file(file);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST(Dressing, adds_lamps_glass_and_images_and_leaves_the_walks_as_they_are) {
  const Folder plain("plain"), dressed("dressed"), tower("tower");
  const SampleReport without = make_building(tiny(false), plain.path()),
                     with = make_building(tiny(true), dressed.path());
  BuildingOptions repeated = tiny(true);
  repeated.floors = 3;
  repeated.repeat_storeys = 1;
  const SampleReport storeys = make_building(repeated, tower.path());
  EXPECT_EQ(without.lights, 0u);
  EXPECT_EQ(without.dressing_placements, 0u);
  EXPECT_GT(with.lights, 50u);
  EXPECT_GT(with.dressing_placements, with.lights);
  EXPECT_EQ(with.shell_placements, without.shell_placements);
  EXPECT_FALSE(std::filesystem::exists(plain.path() / images_folder));
  for (const char* path : {"walk.json", "fly.json", "spin.json", "jump.json"})
    EXPECT_EQ(text_of(plain.path() / path), text_of(dressed.path() / path)) << path;
  const auto gltf = nlohmann::json::parse(text_of(dressed.path() / "scene.gltf"));
  for (const auto& image : gltf["images"])
    EXPECT_TRUE(std::filesystem::exists(dressed.path() / image["uri"].get<std::string>())) << image;
  size_t lights = 0, glowing = 0, cut_out = 0, glass = 0;
  for (const auto& node : gltf["nodes"]) lights += node.contains("extensions");
  for (const auto& material : gltf["materials"]) {
    glowing += material.contains("emissiveFactor");
    cut_out += material.value("alphaMode", "") == "MASK";
    glass += material.value("alphaMode", "") == "BLEND";
  }
  EXPECT_EQ(lights, with.lights);
  EXPECT_EQ(gltf["extensions"]["KHR_lights_punctual"]["lights"].size(), 1u);
  EXPECT_GE(glowing, 1u);
  EXPECT_GE(cut_out, 1u);
  EXPECT_GE(glass, 1u);
  for (const char* file : {"textures/oak.png", "textures/picture3.png"})
    EXPECT_EQ(text_of(dressed.path() / file), text_of(tower.path() / file)) << file << ": the seed decides";
  const auto tall = nlohmann::json::parse(text_of(tower.path() / "scene.gltf"));
  lights = 0;
  for (const auto& node : tall["nodes"]) lights += node.contains("extensions");
  EXPECT_EQ(lights, storeys.lights) << "each storey has its own";
  EXPECT_EQ(nlohmann::json::parse(text_of(plain.path() / "scene.gltf")).count("extensionsUsed"), 0u);
}

TEST(Dressing, hangs_nothing_into_what_stands_there) {
  const BuildingDesign design = design_building(tiny(true));
  const auto& placements = design.furnishing.placements;
  const Dressing dressing = make_dressing(design.plan, design.furniture, placements, Random(5));
  size_t pictures = 0;
  for (const ShellObject& object : dressing.objects) {
    if (!object.name.starts_with("picture")) continue;
    for (const glm::dmat4& place : object.places) {
      ++pictures;
      const glm::dvec3 at(place[3]);
      for (const FurniturePlacement& other : placements) {
        const double level = floor_level(design.plan.rooms[static_cast<size_t>(other.room)].floor);
        const bool beside = at.x > other.footprint.x0 && at.x < other.footprint.x1 &&
                            at.z > other.footprint.z0 && at.z < other.footprint.z1;
        EXPECT_FALSE(beside && at.y > level + other.bottom && at.y < level + other.top);
      }
    }
  }
  EXPECT_GT(pictures, 10u);
}

}  // namespace
}  // namespace triptych
