// What was measured of a device, next to the margins that make culling exact.
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
  int claimed_subpixel_bits = 0;  ///< as the device reports them
  RasterVerdict verdict() const;
};

}  // namespace triptych
