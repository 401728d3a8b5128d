// The sample `building`: an office building in the manner of Soda Hall, furnished with real models.
#pragma once

#include "samples/building/building_paths.hpp"
#include "samples/building/floor_plan.hpp"
#include "samples/building/furnish.hpp"
#include "samples/building/furniture_catalog.hpp"
#include "samples/building/obj_furniture.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace triptych {

struct BuildingOptions {
  int floors = 7;
  std::optional<int> furniture;  ///< wanted placements; by default 2000 per floor
  /// Storeys between the lowest and the highest repeat after this many different ones, and each is a node of
  /// its own in the scene; by default all are different, and placed one by one.
  std::optional<int> repeat_storeys;
  /// Textures, glass in the windows, lamps with lights, curtains, blinds and pictures
  /// (samples/building/dressing.hpp); the rest of the building stays as it is.
  bool effects = false;
  uint64_t seed = 1;  ///< decides everything: equal options give equal files
  std::filesystem::path catalogues = furniture_folder;
};

struct SampleReport {
  int different_storeys = 0;
  size_t rooms = 0;
  size_t placements = 0;        ///< of furniture
  size_t shell_placements = 0;  ///< of slabs, walls, doors, windows, stairs
  size_t furniture_meshes = 0, shell_meshes = 0;
  uint64_t placed_triangles = 0, unique_triangles = 0;  ///< furniture and shell
  size_t lights = 0, dressing_placements = 0;           ///< with BuildingOptions::effects
  std::map<std::string, size_t> skipped_models;         ///< reason: how many
  uint64_t collapsed_triangles = 0, undecoded_images = 0, undefined_materials = 0, transparent_materials = 0;
};

/// What make_building writes, before it is written.
struct BuildingDesign {
  Furniture furniture;
  std::vector<FurnitureMesh> meshes;  ///< by piece; empty where the piece was not read
  FloorPlan plan;                     ///< of the different storeys, one above the other
  Furnishing furnishing;              ///< theirs
  /// For a building that repeats storeys: which of the different ones each storey is.
  std::vector<int> storeys;
  CameraFrames walk, fly, spin, jump;
  std::map<std::string, size_t> skipped_models;
};

/// Error for options out of range (floors 1 to 100, furniture 0 to 1,000,000, storeys that repeat after
/// none), and if no catalogues are installed.
BuildingDesign design_building(const BuildingOptions& options);

/// Writes `scene.gltf`, `scene.bin`, `walk.json`, `fly.json`, `spin.json`, `jump.json` `ATTRIBUTION.txt`,
/// and with effects the images in `textures`.
SampleReport make_building(const BuildingOptions& options, const std::filesystem::path& folder);

}  // namespace triptych
