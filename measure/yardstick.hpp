// What builds are held against: how fast meshoptimizer's simplifier alone halves the same geometry on one
// core.
#pragma once

#include "model/model.hpp"

#include <cstdint>

namespace triptych {

struct Yardstick {
  uint64_t triangles = 0;  ///< that went in; each mesh once
  uint64_t left = 0;       ///< that came out
  double seconds = 0;      ///< in meshopt_simplify alone

  double triangles_per_second() const { return seconds > 0 ? static_cast<double>(triangles) / seconds : 0; }
};

/// Welds each mesh by meshopt's remap and calls meshopt_simplify once, to half of its triangles, without a
/// limit of its error; a mesh of more than `batch_triangles` in batches of so many in the file's order, so
/// that memory stays bounded. Importing, welding and reading are not timed. Errors as MeshStream::read.
Yardstick measure_yardstick(const Model& model, size_t batch_triangles = 1'000'000);

}  // namespace triptych
