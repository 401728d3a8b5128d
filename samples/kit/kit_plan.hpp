// The plan of the sample `kit`: one small building of prisms, which every format can hold.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace triptych {

/// A storey and its height above the building's zero, metres.
struct KitStorey {
  std::string name;
  double elevation = 0;
};

/// A prism: an outline, and how far it reaches across it. Metres; x to the east, y to the north, z up.
struct KitSolid {
  std::string name;
  size_t storey = 0;
  std::array<uint8_t, 3> colour{};  ///< as displayed
  bool upright = true;              ///< outline over x and y, from low to high; else over x and z, along y
  /// Counter-clockwise where the second axis points up. From the first corner every other one can be seen.
  std::vector<glm::dvec2> outline;
  double from = 0, to = 0;
};

/// Triangles of one solid, outward, its corners shared.
struct KitMesh {
  std::vector<glm::dvec3> positions;
  std::vector<std::array<uint32_t, 3>> triangles;
};

const std::vector<KitStorey>& kit_storeys();
/// Some 14 solids in 7 colours. None overlap; the box around all of them has six faces at different distances
/// from the origin, so that a wrong up axis, a turn or a mirror image shows in it.
const std::vector<KitSolid>& kit_solids();

/// Where a point of the outline lies, so far along.
glm::dvec3 kit_point(const KitSolid& solid, const glm::dvec2& point, double along);
/// Caps are fans around the first corner: for n corners 4n − 4 triangles.
KitMesh mesh_of(const KitSolid& solid);
/// From z up to y up, as models are: x stays, north becomes −z.
glm::dvec3 turned_y_up(const glm::dvec3& point);

}  // namespace triptych
