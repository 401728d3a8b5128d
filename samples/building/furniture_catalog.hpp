// The furniture of Debian's package sweethome3d-furniture: zip archives (.sh3f) of OBJ models with a
// catalogue each.
#pragma once

#include "samples/building/zip_archive.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

namespace triptych {

/// One catalogue entry. Local axes: x to its right, y up, z out of its front; metres.
struct FurniturePiece {
  size_t catalogue = 0;
  std::string id, name, category, creator;
  std::string license;               ///< its own where it has one, else the catalogue's
  std::string model;                 ///< OBJ file within the archive
  uint64_t model_bytes = 0;          ///< size of the OBJ text: a first guess at how much geometry there is
  glm::dvec3 size{0};                ///< width (x), height (y), depth (z)
  double elevation = 0;              ///< of its bottom above the floor
  double top = 0;                    ///< where things put on it stand, above its bottom; negative: nowhere
  std::array<double, 9> rotation{};  ///< row-major, applied to the model before it is scaled to `size`
  bool door_or_window = false;
};

struct FurnitureCatalogue {
  std::string name, license;
  std::shared_ptr<const ZipArchive> archive;
};

struct Furniture {
  std::vector<FurnitureCatalogue> catalogues;  ///< by file name
  std::vector<FurniturePiece> pieces;          ///< by catalogue and number
  size_t without_model = 0;                    ///< entries whose model is missing or whose size is invalid
};

/// Where Debian puts the archives.
inline constexpr const char* furniture_folder = "/usr/share/sweethome3d/furniture";

/// Reads every catalogue in the folder. Error that names the Debian package if there is none.
Furniture load_furniture(const std::filesystem::path& folder = furniture_folder);

}  // namespace triptych
