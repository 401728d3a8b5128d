// The inner seam of the 3MF importer: what one model part (the XML within the archive) holds.
#pragma once

#include "model/import/import_file.hpp"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace triptych {

/// An object that another one, or the build, places: by its id, and the part that it is in.
struct ThreeMfUse {
  std::string part;  ///< empty: the same one
  uint64_t object = 0;
  Affine transform{1};
  std::string guid, part_number;  ///< where the use says them itself
};

/// Of a triangle or an object: which colour of which group; no group where there is none.
struct ThreeMfColor {
  uint64_t group = 0;
  uint64_t index = 0;
  bool operator==(const ThreeMfColor&) const = default;
};

struct ThreeMfTriangle {
  std::array<uint32_t, 3> vertices;
  std::optional<ThreeMfColor> color;
};

struct ThreeMfObject {
  std::string name, guid, part_number;
  bool is_support = false;  ///< no part of what is meant ("support", "other")
  std::vector<glm::dvec3> positions;
  std::vector<ThreeMfTriangle> triangles;
  std::vector<ThreeMfUse> components;
  std::optional<ThreeMfColor> color;
};

struct ThreeMfPart {
  double metres = 0.001;  ///< of its unit
  std::map<uint64_t, ThreeMfObject> objects;
  std::map<uint64_t, std::vector<uint32_t>> colors;  ///< groups of 0xRRGGBB
  std::vector<ThreeMfUse> items;                     ///< what the build places
};

/// Parses a model part. Error (place, line) for XML that is not well-formed before any object was read;
/// further on what was read is kept, with a warning. Faces that name vertices which are not there are dropped
/// and counted.
ThreeMfPart parse_3mf_part(const std::shared_ptr<const StreamSource>& source, FileImport& target);

}  // namespace triptych
