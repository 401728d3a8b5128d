// The goals of a run, compared with its figures.
#pragma once

#include "report/report.hpp"

#include <string>
#include <vector>

namespace triptych {

struct Goal {
  std::string what;
  double value = 0, limit = 0;
  bool at_least = false;  ///< the value must be at least the limit; otherwise at most
  int decimals = 0;
  std::vector<std::string> entries;  ///< where the figures come from
  bool held = true;                  ///< otherwise the goal is not meant for this kind of run

  bool met() const { return at_least ? value >= limit : value <= limit; }
  /// "met: 97.10, at least 93.00", "missed by 4.20: 88.80, at least 93.00", or "not held to: 88.80 (at least
  /// 93.00)".
  std::string verdict() const;
};

/// Every goal whose entries the report has: frames identical to the un-culled picture, none left out of the
/// comparison, no digest mismatches, culling efficiency, delta savings, triangles at 8 pixels, and the frame
/// time against full detail. Where the report is only held to exactness, only the first three kinds are held.
std::vector<Goal> judge(const Report& report);

}  // namespace triptych
