// A part: a piece of a mesh after the first partition, small enough to be simplified and drawn as one.
#pragma once

#include "base/record.hpp"
#include "base/spool_file.hpp"
#include "simplify/surface.hpp"

#include <cstdint>
#include <vector>

namespace triptych {

template <>
inline constexpr auto record_members<Surface> = std::tuple(&Surface::points, &Surface::triangles,
                                                           &Surface::colors, &Surface::normals,
                                                           &Surface::file_normals);

/// A point that the part shares with other parts of its mesh.
struct BorderPoint {
  uint32_t point = 0;   ///< index into the surface's points
  uint32_t number = 0;  ///< the same for the same point in all parts of the mesh
};

/// Triangles of a part that follow each other and belong to one closed surface, or to several.
struct PartRun {
  uint32_t triangles = 0;
  uint32_t body =
      0;  ///< of those that are divided among parts; no_id where the part has all of its triangles
  LatticeBox box;
};

/// Its triangles begin with the runs of a Division.
struct Part {
  Surface surface;
  std::vector<BorderPoint> borders;
  bool seen_from_outside = false;  ///< something that others cover was left out
};
template <>
// The borders last: load_borders() reads them alone.
inline constexpr auto record_members<Part> = std::tuple(&Part::seen_from_outside, &Part::surface,
                                                        &Part::borders);

/// Reads a record back from a spool file.
template <typename Value>
Value load(const SpoolFile& file, const SpoolPlace& place) {
  return record_of<Value>(file.read(place), file.path().string());
}

}  // namespace triptych
