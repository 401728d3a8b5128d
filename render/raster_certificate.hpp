// Measures what this machine's OpenGL does where its specification leaves it a choice, and compares it with
// the margins that make culling exact.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace triptych {

/// One measurement and the margin that the product allows for it.
struct RasterFinding {
  std::string name;      ///< "sub-pixel snapping"
  std::string measured;  ///< "2⁻⁹ pixels"
  double value = 0;      ///< the same as a number
  double margin = 0;     ///< the product's; `value` must not exceed it
  std::string unit;      ///< of both
  bool holds() const { return value <= margin; }
};

/// Whether a machine's culled pictures equal its un-culled ones: exact where every measurement is within its
/// margin, conservative where one is not.
enum class RasterVerdict : uint8_t { unknown, exact, conservative };
const std::string& verdict_name(RasterVerdict verdict);

struct RasterCertificate {
  std::vector<RasterFinding> findings;
  int claimed_subpixel_bits = 0;  ///< as OpenGL reports them
  RasterVerdict verdict() const;
};

/// Takes some tens of milliseconds. A context must be current. Measures: by how much snapping moves a vertex;
/// pixels of shared edges that are not drawn exactly once; how far interpolated depth is from exact,
/// relative; fragments on which two of the product's own programs disagree; boxes in front of the depth that
/// the occlusion query, or the storage-buffer test, calls hidden; fragments of equal depth that replace the
/// earlier one.
RasterCertificate measure_raster();

}  // namespace triptych
