// The sample `plant`: a coal-fired power plant in the manner of the model of the University of North
// Carolina: some 1,200 objects from bolts to one network of pipes that runs through it all.
#pragma once

#include "samples/camera_paths.hpp"
#include "samples/random.hpp"

#include <cstdint>
#include <filesystem>

namespace triptych {

inline constexpr uint64_t min_plant_triangles = 50'000, max_plant_triangles = 50'000'000;

struct PlantOptions {
  uint64_t triangles = 12'700'000;  ///< kept within 2 %
  uint64_t seed = 1;                ///< decides everything: equal options give equal files
};

struct PlantReport {
  size_t objects = 0;
  uint64_t triangles = 0, smallest_object = 0, largest_object = 0;
};

/// Writes `scene.gltf`, `scene.bin`, `walk.json`, `fly.json`, `spin.json` and `jump.json`. Not more than one
/// object's triangles of one colour are in memory at a time. Error for a number of triangles out of range.
PlantReport make_plant(const PlantOptions& options, const std::filesystem::path& folder);

/// 300 frames at 1.4 m a second along one walkway, around a corner and along another, 0.5 m from everything.
CameraFrames plant_walk();
/// 300 frames of about 1 m through hall and boiler house; goes through things where it must.
CameraFrames plant_fly();
/// 120 frames where two walkways meet, turning by 3 degrees each.
CameraFrames plant_spin();
/// 60 views from random places, three of four on walkways.
CameraFrames plant_jump(Random random);

}  // namespace triptych
