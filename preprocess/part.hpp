// A part: a piece of a mesh after the first partition, small enough to be simplified and drawn as one.
#pragma once

#include "base/bytes.hpp"
#include "base/spool_file.hpp"
#include "simplify/surface.hpp"

#include <cstdint>
#include <vector>

namespace triptych {

/// A point that the part shares with other parts of its mesh.
struct BorderPoint {
  uint32_t point = 0;   ///< index into the surface's points
  uint32_t number = 0;  ///< the same for the same point in all parts of the mesh
};

struct Part {
  Surface surface;
  std::vector<BorderPoint> borders;
};

void write_surface(ByteWriter& writer, const Surface& surface);
Surface read_surface(ByteReader& reader);

/// Into a spool file and back.
SpoolPlace store(SpoolFile& file, const Part& part);
Part load_part(const SpoolFile& file, const SpoolPlace& place);
/// Only the border points, of which there are `count`.
std::vector<BorderPoint> load_borders(const SpoolFile& file, const SpoolPlace& place, uint32_t count);

}  // namespace triptych
