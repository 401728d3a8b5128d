#include "visibility/raster_certificate.hpp"

#include <algorithm>

namespace triptych {

const std::string& verdict_name(RasterVerdict verdict) {
  static const std::string names[] = {"unknown", "exact", "conservative"};
  return names[static_cast<size_t>(verdict)];
}

RasterVerdict RasterCertificate::verdict() const {
  if (findings.empty()) return RasterVerdict::unknown;
  const bool all =
      std::all_of(findings.begin(), findings.end(), [](const RasterFinding& f) { return f.holds(); });
  return all ? RasterVerdict::exact : RasterVerdict::conservative;
}

}  // namespace triptych
