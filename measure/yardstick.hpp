// A yardstick for builds: how fast meshoptimizer's simplifier halves the same geometry on one core.
#pragma once

#include "model/model.hpp"

#include <cstdint>

namespace triptych {

struct Yardstick {
  uint64_t triangles = 0;  ///< of the input; each mesh once
  uint64_t left = 0;       ///< triangles of the result
  double seconds = 0;      ///< in meshopt_simplify only

  double triangles_per_second() const { return seconds > 0 ? static_cast<double>(triangles) / seconds : 0; }
};

/// Welds each mesh by meshopt's remap and calls meshopt_simplify once, to half of its triangles, without a
/// limit of its error; a mesh of more than `batch_triangles` is simplified in batches of that size in the
/// file's order, so that memory stays bounded. Importing, welding and reading are not timed. Errors as
/// MeshStream::read.
Yardstick measure_yardstick(const Model& model, size_t batch_triangles = 1'000'000);

}  // namespace triptych
