#include "view/outline.hpp"

#include "scene/hidden_objects.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace triptych {

namespace {

constexpr double crease = 0.34;        // the sine of 20 degrees
constexpr double least_turn = 1e-4;    // of what may be seen from the side
constexpr size_t most_lines = 12'000;  // more would hide what they outline

bool is_hidden(const FrameState& frame, SourceObjectId object) {
  const HiddenObjects* const hidden = frame.hiding.objects.get();
  return hidden && std::ranges::binary_search(hidden->objects(), object);
}

/// False where that makes more than there may be.
bool add_placement(const Skeleton& skeleton, const Poses* poses, ChunkShelf& chunks, DrawableId drawable,
                   uint32_t placement, std::vector<NearFacet>& facets) {
  const Placement& placed = skeleton.placements[skeleton.drawables[drawable].first_placement + placement];
  if (facets.size() + skeleton.chunks[placed.chunk].triangle_count > SelectionOutline::most_triangles)
    return false;
  const Affine transform = placed_transform(skeleton, poses, placed);
  const std::shared_ptr<const Chunk> chunk = chunks.get(placed.chunk);
  for (uint32_t i = 0; i < chunk->triangle_count(); ++i) {
    NearFacet facet{{}, drawable, placement, i};
    for (size_t k = 0; k < 3; ++k)
      facet.corners[k] =
          placed_position(skeleton, placed, transform, *chunk, chunk->indices[size_t{3} * i + k]);
    facets.push_back(facet);
  }
  return true;
}

std::vector<NearFacet> facets_of(const Skeleton& skeleton, const Poses* poses, ChunkShelf& chunks,
                                 Selector& selector, const Selection& selection) {
  std::vector<NearFacet> facets;
  if (selection.object == no_id) {
    const SceneNode& node = skeleton.scene_nodes[skeleton.drawables[selection.picked->drawable].scene_node];
    // All drawables of a leaf place the same parts in the same order.
    if (node.child_count == 0)
      add_placement(skeleton, poses, chunks, node.first_drawable, selection.picked->placement, facets);
    return facets;
  }
  const PackObjects& objects = selector.objects();
  for (const SourceObjectId part : selector.parts_of(selection.object)) {
    for (const SceneNodeId leaf : objects.nodes_of(part)) {
      uint32_t placement = 0;
      for (const ObjectRun& run : objects.runs_of(leaf)) {
        for (uint32_t i = 0; i < run.placements; ++i, ++placement) {
          if (run.object != part) continue;
          const DrawableId finest = skeleton.scene_nodes[leaf].first_drawable;
          if (!add_placement(skeleton, poses, chunks, finest, placement, facets)) return {};
        }
      }
    }
  }
  return facets;
}

}  // namespace

SelectionOutline::SelectionOutline(const Skeleton& skeleton, ChunkShelf& chunks, Selector& selector,
                                   const std::vector<Selection>& selected, const FrameState& frame)
    : poses_(poses_of(skeleton, frame)) {
  uint64_t triangles = 0;
  size_t creases = 0;
  for (const Selection& selection : selected) {
    Piece& piece = pieces_.emplace_back(Piece{selection.object, selection.box, {}});
    triangles += selection.triangles;
    if (triangles > most_triangles || creases > most_lines) continue;
    piece.edges = feature_edges(facets_of(skeleton, poses_.get(), chunks, selector, selection),
                                skeleton.lattice().step / 2, least_turn);
    creases += static_cast<size_t>(std::count_if(
        piece.edges.begin(), piece.edges.end(), [](const FeatureEdge& edge) { return edge.turn >= crease; }));
    if (creases > most_lines) piece.edges.clear();
  }
}

void SelectionOutline::draw(Overlay& overlay, const FrameState& frame) const {
  const Camera& camera = frame.view.camera;
  const glm::dvec3 eye = camera.eye, sight = camera.target - eye;
  size_t lines = 0;
  for (const Piece& piece : pieces_) {
    if (is_hidden(frame, piece.object)) continue;
    if (piece.edges.empty() && !piece.box.empty()) overlay.box(piece.box, selection_color);
    for (const FeatureEdge& edge : piece.edges) {
      const glm::dvec3 way = camera.orthographic() ? sight : edge.from - eye;
      const bool turns_away = (glm::dot(edge.normals[0], way) < 0) != (glm::dot(edge.normals[1], way) < 0);
      if (edge.turn < crease && !turns_away) continue;
      if (++lines > most_lines) return;
      overlay.thin_line(edge.from, edge.to, selection_color);
    }
  }
}

}  // namespace triptych
