#include "lod/representation.hpp"

namespace triptych {

const std::string& LevelsRepresentation::name() const {
  static const std::string name = "levels";
  return name;
}

void LevelsRepresentation::append(DrawableId id, std::vector<DrawItem>& items) {
  const Skeleton& skeleton = hierarchy_.skeleton();
  const std::span<const LatticeBox> boxes = hierarchy_.placed(id).pieces;
  size_t piece = 0;
  for (const Placement& placement : hierarchy_.placements_of(id)) {
    const size_t pieces = skeleton.pieces_of(placement.chunk).size();
    const uint32_t triangles = skeleton.chunks[placement.chunk].triangle_count;
    if (triangles > 0) {
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
