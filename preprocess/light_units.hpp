// Points at which light is gathered, as units of a build.
#pragma once

#include "light/run_points.hpp"
#include "preprocess/build_work.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace triptych {

/// RunPoints, in units of some points each, batch after batch; what an earlier run has done of them is taken
/// from the build's journal.
class LightUnits {
 public:
  explicit LightUnits(BuildWork& work) : work_(work) {}

  std::vector<float> run(const std::string& what, uint32_t count, const PointValues& of_item);

  /// Points of one unit, and units of one batch: what a killed build loses at most.
  static constexpr uint32_t unit_points = 256, batch_units = 64;

 private:
  BuildWork& work_;
  uint32_t before_ = 0;  ///< how many units came before, of other points
};

}  // namespace triptych
