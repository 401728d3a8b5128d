// Which triangles of a surface lie beside each other.
#pragma once

#include "simplify/surface.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace triptych {

/// A surface that turns by more than 30 degrees from one triangle to the next is folded there: their normals'
/// cosine is less.
inline constexpr double fold_cosine = 0.866;

/// The triangles beside each triangle, by its edges from corner k to the next; no_id where there is none. Of
/// edges with more than two triangles, only those that were found first.
class TriangleNeighbors {
 public:
  explicit TriangleNeighbors(const std::vector<Triangle>& triangles);
  const std::array<uint32_t, 3>& of(uint32_t triangle) const { return beside_[triangle]; }

 private:
  std::vector<std::array<uint32_t, 3>> beside_;
};

}  // namespace triptych
