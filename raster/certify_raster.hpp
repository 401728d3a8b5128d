// Measures what the rasteriser does on this machine, and compares it with the margins that make culling
// exact.
#pragma once

#include "visibility/raster_certificate.hpp"

namespace triptych {

/// Takes some tens of milliseconds. Measures: by how much snapping moves a vertex; pixels of shared edges
/// that are not drawn exactly once; how far depth is from exact, relative; pixels that another order of
/// drawing changes; boxes in front of the depth that the box test calls hidden.
RasterCertificate certify_raster();

}  // namespace triptych
