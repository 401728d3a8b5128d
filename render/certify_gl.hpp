// Measures what this machine's OpenGL does where its specification leaves it a choice, and compares it with
// the margins that make culling exact.
#pragma once

#include "visibility/raster_certificate.hpp"

namespace triptych {

/// Takes some tens of milliseconds. A context must be current. Measures: by how much snapping moves a vertex;
/// pixels of shared edges that are not drawn exactly once; how far interpolated depth is from exact,
/// relative; fragments on which two of the product's own programs disagree; boxes in front of the depth that
/// the occlusion query, or the storage-buffer test, calls hidden; fragments of equal depth that replace the
/// earlier one.
RasterCertificate certify_gl();

}  // namespace triptych
