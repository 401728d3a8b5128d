// Triangles divided at the middles of some of their edges.
#pragma once

#include "light/lit_model.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

/// An edge by its places, the lower one in the upper half.
inline uint64_t edge_key(uint32_t a, uint32_t b) {
  return a < b ? uint64_t{a} << 32 | b : uint64_t{b} << 32 | a;
}

/// Every triangle that has one of the edges (sorted keys) is divided there, of whichever object it is, so
/// that no corner comes to lie within another triangle's edge. What corners have is halfway between that of
/// the edge's ends. Triangles stay in the order of their instances.
void split_edges(LitModel& model, std::span<const uint64_t> edges);

}  // namespace triptych
