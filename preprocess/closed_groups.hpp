// Triangles that enclose something together: how surfaces are found to be closed.
#pragma once

#include "base/disjoint_sets.hpp"
#include "simplify/surface.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

namespace triptych {

/// Triangles that hang together by edges: by those with exactly two triangles, which go along it in opposite
/// directions, and around others by wedges (preprocess/edge_wedges.hpp); groups each of whose triangles has a
/// neighbour at every edge. Solids that touch are groups each for itself.
class ClosedGroups {
 public:
  using Corners = std::array<uint32_t, 3>;

  /// Points with different indices lie at different places, within ±2^29.
  ClosedGroups(std::span<const glm::ivec3> points, std::span<const Corners> triangles);

  /// Calls visit(triangles) for each, ascending.
  template <typename Visit>
  void visit(const Visit& visit) {
    std::vector<std::pair<uint32_t, uint32_t>> members;  // root, triangle
    std::vector<bool> open_roots(is_open_.size());
    for (uint32_t i = 0; i < is_open_.size(); ++i) {
      const uint32_t root = sets_.root(i);
      members.emplace_back(root, i);
      if (is_open_[i]) open_roots[root] = true;
    }
    std::sort(members.begin(), members.end());
    std::vector<uint32_t> group;
    for (size_t i = 0; i < members.size(); ++i) {
      group.push_back(members[i].second);
      if (i + 1 < members.size() && members[i + 1].first == members[i].first) continue;
      if (!open_roots[members[i].first]) visit(std::span<const uint32_t>(group));
      group.clear();
    }
  }

 private:
  struct Edge {
    uint64_t key;
    uint32_t triangle;
    uint32_t apex;  ///< the triangle's third corner
    bool forward;
  };
  void join_wedges(std::span<const glm::ivec3> points, std::span<const Edge> edges);

  DisjointSets sets_;
  std::vector<bool> is_open_;
};

/// The closed surfaces among a surface's triangles.
struct ClosedTriangles {
  std::vector<uint32_t> body_of;  ///< for each triangle a number below `bodies`; no_id of what is not closed
  uint32_t bodies = 0;
};

/// ClosedGroups; and of the rest what hangs together by edges, each of which is passed as often one way as
/// the other. Neither asks whether surfaces meet themselves.
ClosedTriangles find_closed(const Surface& surface);

/// Turns round closed surfaces that are inside out: those that hold a negative volume and lie in the box of
/// no other one, and with such a one all that lie in its box, as the walls of its cavities do; but nothing
/// that lies in the box of one that is not turned. Returns how many.
uint64_t turn_outward(Surface& surface, const ClosedTriangles& closed);

/// Makes one of a closed surface that is inside out and all in whose boxes it lies, as the wall of a cavity
/// and the outside around it: inside of them is what they have in common. One that lies in none is closed no
/// more.
void join_cavities(const Surface& surface, ClosedTriangles& closed);

/// A sum over triangles' edges that is 0 where each edge is passed as often one way as the other, whichever
/// surfaces the triangles come from; any other sum is 0 by a chance of 2^-128.
struct EdgeSum {
  uint64_t low = 0, high = 0;

  /// On one lattice.
  void add(const std::array<glm::ivec3, 3>& triangle);
  void add(const EdgeSum& other) {
    low += other.low;
    high += other.high;
  }
  bool is_closed() const { return low == 0 && high == 0; }
};

}  // namespace triptych
