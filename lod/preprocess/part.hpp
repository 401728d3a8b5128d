// A part: a piece of a mesh after the first partition, small enough to be simplified and drawn as one.
#pragma once

#include "base/bytes.hpp"
#include "base/spool_file.hpp"
#include "scene/surface.hpp"

#include <cstdint>
#include <vector>

namespace triptych {

/// A point that the part shares with other parts of its mesh.
struct BorderPoint {
  uint32_t point = 0;    ///< index into the surface's points
  uint32_t ordinal = 0;  ///< which of the part's border points it is, at any level of detail
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

}  // namespace triptych
