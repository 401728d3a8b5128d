#include "lod/draw_rank.hpp"

#include "base/rounding.hpp"
#include "lod/frame_view.hpp"

#include <algorithm>
#include <glm/common.hpp>

namespace triptych {

glm::ivec3 eye_cell(const Skeleton& skeleton, const View& view) {
  const Lattice& lattice = skeleton.lattice();
  const glm::dvec3 cell =
      glm::floor(round_to_nearest([&] { return (view.camera.eye - lattice.origin) / lattice.step; }));
  return glm::ivec3(glm::clamp(cell, glm::dvec3(-Lattice::limit), glm::dvec3(Lattice::limit)));
}

uint64_t squared_distance(const glm::ivec3& cell, const LatticeBox& box) {
  // Each difference is below 2^31, its square below 2^62, the sum below 2^64.
  uint64_t sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int64_t below = int64_t{box.lo[axis]} - cell[axis], above = int64_t{cell[axis]} - box.hi[axis];
    const auto outside = static_cast<uint64_t>(std::max({below, above, int64_t{0}}));
    sum += outside * outside;
  }
  return sum;
}

DrawRank draw_rank(const Skeleton& skeleton, const glm::ivec3& cell, DrawableId drawable) {
  return {squared_distance(cell, skeleton.scene_nodes[skeleton.drawables[drawable].scene_node].box),
          drawable};
}

DrawRank draw_rank(const FrameView& view, DrawableId drawable) {
  const SceneNodeId node = view.skeleton->drawables[drawable].scene_node;
  // What moves and cannot be in view, as what has left it, is not evaluated to be told that it has.
  const LatticeBox& always = view.skeleton->scene_nodes[node].box;
  const bool is_gone = view.moves(node) && view.eye_space.bounds(always).outside;
  return {squared_distance(view.cell, is_gone ? always : view.box(node)), drawable};
}

void RankSorter::sort(const FrameView& view, std::vector<DrawableId>& drawables) {
  ranks_.clear();
  for (const DrawableId id : drawables) ranks_.push_back(draw_rank(view, id));
  std::sort(ranks_.begin(), ranks_.end());
  std::transform(ranks_.begin(), ranks_.end(), drawables.begin(),
                 [](const DrawRank& rank) { return rank.id; });
}

void sort_by_rank(const FrameView& view, std::vector<DrawableId>& drawables) {
  RankSorter().sort(view, drawables);
}

void sort_by_rank(const Skeleton& skeleton, const glm::ivec3& cell, std::vector<DrawableId>& drawables) {
  std::ranges::sort(drawables, {}, [&](DrawableId id) { return draw_rank(skeleton, cell, id); });
}

}  // namespace triptych
