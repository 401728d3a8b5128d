// What this machine's OpenGL does where its specification leaves it room: measured, and held against the
// margins that make culling exact.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace triptych {

/// One thing measured and the margin that the product allows for it.
struct RasterFinding {
  std::string name;      ///< "sub-pixel snapping"
  std::string measured;  ///< "2⁻⁹ pixels"
  double value = 0;      ///< the same as a number
  double margin = 0;     ///< the product's; `value` must not exceed it
  std::string unit;      ///< of both
  bool holds() const { return value <= margin; }
};

/// How sure a machine's pictures are: exact where everything measured is within its margin (then culled
/// pictures equal un-culled ones), conservative where something is not.
enum class RasterVerdict : uint8_t { unknown, exact, conservative };
const std::string& verdict_name(RasterVerdict verdict);

struct RasterCertificate {
  std::vector<RasterFinding> findings;
  int claimed_subpixel_bits = 0;  ///< what OpenGL says of itself
  RasterVerdict verdict() const;
};

/// Takes some tens of milliseconds. A context must be current. Measures: by how much snapping moves a vertex;
/// pixels of shared edges that are drawn not exactly once; how far interpolated depth is from exact,
/// relative; fragments on which two of the product's own programs disagree; boxes in front of the depth whose
/// occlusion query, or storage-buffer test, says hidden; pixels of equal depth that the later one takes.
RasterCertificate measure_raster();

}  // namespace triptych
