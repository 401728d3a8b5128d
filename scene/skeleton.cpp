#include "scene/skeleton.hpp"

#include "scene/finest_boxes.hpp"

#include <algorithm>
#include <cmath>
#include <glm/vec4.hpp>
#include <limits>
#include <numeric>

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

/// The smallest diagonal of what stands alone, or of the whole if nothing does; infinite for points.
double least_alone(const Skeleton& skeleton) {
  const auto& nodes = skeleton.scene_nodes;
  const auto size_of = [](double length) {
    return length > 0 ? length : std::numeric_limits<double>::infinity();
  };
  const std::vector<Box> boxes = finest_boxes(skeleton);
  std::vector<double> diagonals(nodes.size()), filled(nodes.size());  // filled: the sum over leaves below
  for (size_t i = nodes.size(); i-- > 0;) {                           // children come after their parents
    diagonals[i] = diagonal(boxes[i]);
    if (nodes[i].child_count == 0) filled[i] = diagonals[i];
    if (nodes[i].parent != no_id) filled[nodes[i].parent] += filled[i];
  }
  double least = size_of(diagonals[0]);
  std::vector<SceneNodeId> open{0};
  while (!open.empty()) {
    const SceneNodeId id = open.back();
    const SceneNode& node = nodes[id];
    open.pop_back();
    least = std::min(least, size_of(diagonals[id]));
    if (node.child_count > 0 && filled[id] <= min_filled * diagonals[id]) {
      for (uint32_t child = 0; child < node.child_count; ++child) open.push_back(node.first_child + child);
    }
    if (node.child_count > 0) continue;
    const auto pieces = piece_diagonals(skeleton, skeleton.drawables[node.first_drawable]);
    if (std::accumulate(pieces.begin(), pieces.end(), 0.0) > min_filled * diagonals[id]) continue;
    for (const double piece : pieces) least = std::min(least, size_of(piece));
  }
  return least;
}

}  // namespace

double Skeleton::default_near() const {
  if (scene_nodes.empty()) return 1e-6;
  const double least = least_alone(*this);
  return std::max(std::isfinite(least) ? 1e-4 * least : 0, lattice().step);
}

}  // namespace triptych
