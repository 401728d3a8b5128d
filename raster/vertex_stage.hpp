// From vertices of chunks to clip space, under one view.
#pragma once

#include "raster/chunk_geometry.hpp"
#include "visibility/vertex_terms.hpp"

namespace triptych {

struct VertexStage {
  explicit VertexStage(const FrameView& view);

  ClipTerms clip;
  bool orthographic;

  /// A vertex in clip space, computed in floats (glm::vec4) or, from the same terms, in doubles (glm::dvec4).
  template <typename Position>
  Position to_clip(const PlacedLattice& placed, const RasterChunk& chunk, size_t vertex) const;
};

}  // namespace triptych
