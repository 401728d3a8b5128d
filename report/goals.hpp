// What a run must reach, held against its figures.
#pragma once

#include "report/report.hpp"

#include <string>
#include <vector>

namespace triptych {

struct Goal {
  std::string what;
  double value = 0, limit = 0;
  bool at_least = false;  ///< the value must reach the limit; otherwise it must not pass it
  int decimals = 0;
  std::vector<std::string> entries;  ///< where the figures come from
  bool held = true;                  ///< otherwise the target is set for another run than this one

  bool met() const { return at_least ? value >= limit : value <= limit; }
  /// "met: 97.10, at least 93.00", "missed by 4.20: 88.80, at least 93.00", or "not held to: 88.80 (at least
  /// 93.00)".
  std::string verdict() const;
};

/// Every target whose entries the report has: frames identical to the un-culled picture, none left out of the
/// comparison, no digest mismatches, culling efficiency, delta savings, triangles at 8 pixels, and the frame
/// time against full detail. Where the report is held to exactness alone, the first three kinds are held.
std::vector<Goal> judge(const Report& report);

}  // namespace triptych
