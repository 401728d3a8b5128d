// What of a model lies right beneath other surfaces.
#pragma once

#include <cstdint>

namespace triptych {

struct CoveredReport {
  uint64_t triangles = 0;  ///< in parts, that are covered wherever they are placed
  uint64_t parts = 0;      ///< that cover others or are covered, so that some errors are not for them
};

}  // namespace triptych
