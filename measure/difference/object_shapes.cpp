#include "measure/difference/object_shapes.hpp"

#include "base/hashing.hpp"
#include "scene/transforms.hpp"

#include <cmath>
#include <glm/vec4.hpp>

namespace triptych {

namespace {

/// Calls take(object, placement) for everything that leaves show at full detail; no_id: of no object.
template <typename Take>
void each_placement(const Skeleton& skeleton, const PackObjects& objects, const Take& take) {
  for (SceneNodeId id = 0; id < skeleton.scene_nodes.size(); ++id) {
    const SceneNode& node = skeleton.scene_nodes[id];
    if (node.child_count > 0) continue;
    const Drawable& finest = skeleton.drawables[node.first_drawable];
    uint32_t next = finest.first_placement;
    for (const ObjectRun& run : objects.runs_of(id)) {
      for (uint32_t i = 0; i < run.placements; ++i) take(run.object, skeleton.placements[next++]);
    }
    while (next < finest.first_placement + finest.placement_count) take(no_id, skeleton.placements[next++]);
  }
}

}  // namespace

ObjectShapes::ObjectShapes(const Pack& pack, const PackObjects& objects)
    : pack_(pack), firsts_(objects.source().objects.size() + 2, 0) {
  const Skeleton& skeleton = pack.skeleton();
  const auto slot = [&](SourceObjectId object) { return std::min<size_t>(object, nameless()); };
  each_placement(skeleton, objects,
                 [&](SourceObjectId object, const Placement&) { ++firsts_[slot(object) + 1]; });
  for (size_t i = 1; i < firsts_.size(); ++i) firsts_[i] += firsts_[i - 1];
  placements_.resize(firsts_.back());
  std::vector<uint64_t> next(firsts_.begin(), firsts_.end() - 1);
  each_placement(skeleton, objects, [&](SourceObjectId object, const Placement& placement) {
    placements_[next[slot(object)]++] = placement;
  });
  palette_hash_ = hash_values(std::span(skeleton.palette));
}

std::span<const Placement> ObjectShapes::placements_of(SourceObjectId object) const {
  return std::span(placements_).subspan(firsts_[object], firsts_[object + 1] - firsts_[object]);
}

uint64_t ObjectShapes::triangles_of(SourceObjectId object) const {
  uint64_t triangles = 0;
  for (const Placement& placement : placements_of(object))
    triangles += pack_.skeleton().chunks[placement.chunk].triangle_count;
  return triangles;
}

Box ObjectShapes::box_of(SourceObjectId object) const {
  const Skeleton& skeleton = pack_.skeleton();
  Box box;
  for (const Placement& placement : placements_of(object)) {
    const ChunkInfo& chunk = skeleton.chunks[placement.chunk];
    box.extend(placed_box(skeleton.transforms[placement.transform],
                          skeleton.lattices[chunk.lattice].box(chunk.box)));
  }
  return box;
}

uint64_t ObjectShapes::signature_of(SourceObjectId object) const {
  const Skeleton& skeleton = pack_.skeleton();
  uint64_t sum = 0;
  for (const Placement& placement : placements_of(object)) {
    const ChunkInfo& chunk = skeleton.chunks[placement.chunk];
    uint64_t hash = hash_values(std::span(&skeleton.transforms[placement.transform], 1), palette_hash_);
    hash = hash_values(std::span(&skeleton.lattices[chunk.lattice], 1), hash);
    sum += hash_values(std::span(&chunk.checksum, 1), hash);
  }
  return sum;
}

PlacedShape ObjectShapes::shape_of(SourceObjectId object) const {
  const Skeleton& skeleton = pack_.skeleton();
  // To the nearest lattice point, and by one more step in each direction where a triangle was enlarged.
  constexpr double most_steps = 1.5 * 1.7320508075688773;
  PlacedShape shape;
  shape.facets.reserve(triangles_of(object));
  for (const Placement& placement : placements_of(object)) {
    const Chunk chunk = pack_.read_chunk(placement.chunk);
    const Lattice& lattice = skeleton.lattices[skeleton.chunks[placement.chunk].lattice];
    const Affine& transform = skeleton.transforms[placement.transform];
    shape.tolerance = std::max(shape.tolerance, most_steps * lattice.step * largest_stretch(transform));
    for (size_t i = 0; i < chunk.indices.size(); i += 3) {
      PlacedShape::Facet facet;
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t vertex = chunk.indices[i + k];
        const ChunkVertex& from = chunk.vertices[vertex];
        facet.corners[k] = transform * glm::dvec4(lattice.position(from.point), 1);
        facet.colors[k] = chunk.colors.empty() ? skeleton.palette[from.color] : chunk.colors[vertex];
        shape.box.extend(facet.corners[k]);
      }
      shape.facets.push_back(facet);
    }
  }
  return shape;
}

}  // namespace triptych
