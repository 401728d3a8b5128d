#include "lod/representation.hpp"

namespace triptych {

const std::string& LevelsRepresentation::name() const {
  static const std::string name = "levels";
  return name;
}

void LevelsRepresentation::append(DrawableId id, std::vector<DrawItem>& items) {
  const Skeleton& skeleton = hierarchy_.skeleton();
  const std::span<const LatticeBox> boxes = hierarchy_.placed(id, view_->poses.get()).pieces;
  const std::span<const Placement> placements = hierarchy_.placements_of(id);
  std::span<const PlacementRun> hidden;
  if (view_->state.hiding.objects)
    hidden = view_->state.hiding.objects->hidden_placements(skeleton.drawables[id].scene_node);
  size_t piece = 0;
  for (uint32_t i = 0; i < placements.size(); ++i) {
    const Placement& placement = placements[i];
    const size_t pieces = skeleton.pieces_of(placement.chunk).size();
    const uint32_t triangles = skeleton.chunks[placement.chunk].triangle_count;
    if (!hidden.empty() && i >= hidden.front().end) hidden = hidden.subspan(1);
    const bool shows = hidden.empty() || i < hidden.front().first;
    if (shows && triangles > 0) {
      items.push_back({.drawable = id,
                       .chunk = placement.chunk,
                       .transform = placement.transform,
                       .first_index = 0,
                       .index_count = 3 * triangles,
                       .pieces = boxes.subspan(piece, pieces)});
    }
    piece += pieces;
  }
}

}  // namespace triptych
