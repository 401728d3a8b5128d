// The geometry of a drawable as it is drawn, in model space and double.
#pragma once

#include "scene/pack.hpp"
#include "tests/support/corners.hpp"

#include <glm/matrix.hpp>
#include <utility>
#include <vector>

namespace triptych::judge {

/// Model units; turned as they are seen, under mirroring transforms too.
inline std::vector<Corners> triangles_of(const Pack& pack, DrawableId id) {
  const Skeleton& skeleton = pack.skeleton();
  const Drawable& drawable = skeleton.drawables[id];
  std::vector<Corners> result;
  for (uint32_t i = 0; i < drawable.placement_count; ++i) {
    const Placement& placement = skeleton.placements[drawable.first_placement + i];
    const Chunk chunk = pack.read_chunk(placement.chunk);
    const Lattice& lattice = skeleton.lattices[skeleton.chunks[placement.chunk].lattice];
    const Affine& transform = skeleton.transforms[placement.transform];
    const bool mirrors = glm::determinant(glm::dmat3(transform)) < 0;
    for (size_t k = 0; k < chunk.indices.size(); k += 3) {
      Corners corners;
      for (size_t c = 0; c < 3; ++c) {
        corners[c] = transform * glm::dvec4(lattice.position(chunk.vertices[chunk.indices[k + c]].point), 1);
      }
      if (mirrors) std::swap(corners[1], corners[2]);
      result.push_back(corners);
    }
  }
  return result;
}

}  // namespace triptych::judge
