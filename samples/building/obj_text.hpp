// The Wavefront text formats: OBJ geometry and MTL materials, as far as furniture needs them.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace triptych {

struct ObjMaterial {
  glm::dvec3 diffuse{0.8};  ///< Kd, as written
  double opacity = 1;       ///< d
  std::string texture;      ///< map_Kd: file name, empty without one
};

/// Corners of the polygons of one material: `sizes[i]` indices each.
struct ObjPolygons {
  std::vector<uint32_t> corners;
  std::vector<uint32_t> sizes;
};

struct ObjModel {
  std::vector<glm::dvec3> positions;
  std::vector<std::string> material_libraries;
  std::vector<std::string> materials;  ///< names in the order of first use
  std::vector<ObjPolygons> polygons;   ///< one for each material
};

/// Reads `v`, `f` (also with negative indices), `usemtl` and `mtllib`; other lines carry nothing that is
/// drawn here. Error (place, line) for an invalid number or an index out of range.
ObjModel parse_obj(std::string_view text, const std::string& place);

/// Materials by name. Error (place, line) for an invalid number.
std::map<std::string, ObjMaterial> parse_mtl(std::string_view text, const std::string& place);

}  // namespace triptych
