// Which of many boxes overlap each other.
#pragma once

#include "scene/box.hpp"

#include <cstdint>
#include <vector>

namespace triptych {

struct OverlappingBoxes {
  /// For each box those larger ones (of equal ones those with a smaller index) that share a point with it.
  std::vector<std::vector<uint32_t>> larger;
  uint64_t crowded = 0;  ///< boxes for which some of these were left out, since there are more than asked for
};

/// At most `most` larger ones for each box: of boxes that all lie in one place every pair would be one. Run
/// on all cores.
OverlappingBoxes overlapping_boxes(const std::vector<Box>& boxes, size_t most);

}  // namespace triptych
