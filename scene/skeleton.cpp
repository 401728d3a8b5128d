#include "scene/skeleton.hpp"

#include <algorithm>
#include <cmath>
#include <glm/vec4.hpp>
#include <limits>

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

namespace {

/// Where parts fill less of a whole's diagonal, they stand alone.
constexpr double min_filled = 0.1;

/// Diagonals of the boxes that a drawable is tested by, as placed.
std::vector<double> piece_diagonals(const Skeleton& skeleton, const Drawable& drawable) {
  std::vector<double> diagonals;
  for (uint32_t i = 0; i < drawable.placement_count; ++i) {
    const Placement& placement = skeleton.placements[drawable.first_placement + i];
    const Lattice& lattice = skeleton.lattices[skeleton.chunks[placement.chunk].lattice];
    for (const LatticeBox& piece : skeleton.pieces_of(placement.chunk)) {
      Box placed;
      for (int corner = 0; corner < 8; ++corner)
        placed.extend(skeleton.transforms[placement.transform] *
                      glm::dvec4(lattice.position(piece.corner(corner)), 1));
      diagonals.push_back(diagonal(placed));
    }
  }
  return diagonals;
}

double diagonal_of(const Skeleton& skeleton, const SceneNode& node) {
  return diagonal(skeleton.lattice().box(node.box));
}

/// Whether the diagonals of leaves below, or of a leaf's pieces, make up next to nothing of the node's.
bool is_scattered(const Skeleton& skeleton, const SceneNode& node) {
  double left = min_filled * diagonal_of(skeleton, node);
  std::vector<const SceneNode*> open{&node};
  while (!open.empty() && left >= 0) {
    const SceneNode& next = *open.back();
    open.pop_back();
    for (uint32_t child = 0; child < next.child_count; ++child)
      open.push_back(&skeleton.scene_nodes[next.first_child + child]);
    if (next.child_count > 0) continue;
    if (&next == &node) {
      for (const double piece : piece_diagonals(skeleton, skeleton.drawables[node.first_drawable]))
        left -= piece;
    } else {
      left -= diagonal_of(skeleton, next);
    }
  }
  return left >= 0;
}

/// The smallest diagonal of what stands alone below a scene node, or its own; infinite for points.
double least_alone(const Skeleton& skeleton, const SceneNode& node) {
  const auto size_of = [](double length) {
    return length > 0 ? length : std::numeric_limits<double>::infinity();
  };
  double least = size_of(diagonal_of(skeleton, node));
  if (!is_scattered(skeleton, node)) return least;
  if (node.child_count == 0) {
    for (const double piece : piece_diagonals(skeleton, skeleton.drawables[node.first_drawable]))
      least = std::min(least, size_of(piece));
  }
  for (uint32_t child = 0; child < node.child_count; ++child)
    least = std::min(least, least_alone(skeleton, skeleton.scene_nodes[node.first_child + child]));
  return least;
}

}  // namespace

double Skeleton::default_near() const {
  if (scene_nodes.empty()) return 1e-6;
  const double least = least_alone(*this, scene_nodes[0]);
  return std::max(std::isfinite(least) ? 1e-4 * least : 0, lattice().step);
}

}  // namespace triptych
