#include "preprocess/triangle_neighbors.hpp"

#include "simplify/key_hash.hpp"

#include <algorithm>
#include <tsl/robin_map.h>

namespace triptych {

TriangleNeighbors::TriangleNeighbors(const std::vector<Triangle>& triangles)
    : beside_(triangles.size(), {no_id, no_id, no_id}) {
  tsl::robin_map<std::array<uint32_t, 2>, std::array<uint32_t, 2>, KeyHash, KeyEqual> open;
  for (uint32_t i = 0; i < triangles.size(); ++i) {
    for (uint32_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(triangles[i].vertices[k], triangles[i].vertices[(k + 1) % 3]);
      const auto [found, inserted] = open.try_emplace({low, high}, std::array{i, k});
      if (inserted || found->second[0] == i) continue;
      const auto [other, side] = found->second;
      if (beside_[other][side] != no_id) continue;
      beside_[other][side] = i;
      beside_[i][k] = other;
    }
  }
}

}  // namespace triptych
