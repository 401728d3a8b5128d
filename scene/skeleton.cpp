#include "scene/skeleton.hpp"

#include <algorithm>

namespace triptych {

uint32_t Skeleton::levels() const {
  std::vector<uint32_t> depth(scene_nodes.size(), 1);
  uint32_t deepest = 0;
  for (size_t i = 0; i < scene_nodes.size(); ++i) {  // parents come before their children
    if (scene_nodes[i].parent != no_id) depth[i] = depth[scene_nodes[i].parent] + 1;
    deepest = std::max(deepest, depth[i]);
  }
  return deepest;
}

std::span<const LatticeBox> Skeleton::pieces_of(uint32_t chunk) const {
  const size_t first = chunks[chunk].first_piece;
  const size_t end = chunk + 1 < chunks.size() ? chunks[chunk + 1].first_piece : pieces.size();
  return first == end ? std::span(&chunks[chunk].box, 1) : std::span(pieces).subspan(first, end - first);
}

double Skeleton::diagonal() const {
  if (scene_nodes.empty()) return 0;
  const Box box = lattice().box(scene_nodes[0].box);
  return triptych::diagonal(box);
}

double Skeleton::default_near() const {
  return std::max(diagonal() * 1e-4, lattices.empty() ? 1e-6 : lattice().step);
}

}  // namespace triptych
