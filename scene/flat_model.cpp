#include "scene/flat_model.hpp"

#include "base/error.hpp"
#include "base/threads.hpp"

#include <algorithm>
#include <glm/vec4.hpp>
#include <limits>

namespace triptych {

namespace {

/// A chunk in one of its places, and where it goes in the lists.
struct Place {
  uint32_t chunk = 0, transform = 0;
  uint64_t first_vertex = 0, first_index = 0;
};

std::vector<Place> places_of_leaves(const Skeleton& skeleton, const HiddenObjects* hidden) {
  std::vector<Place> places;
  uint64_t vertices = 0, indices = 0;
  for (const SceneNode& node : skeleton.scene_nodes) {
    if (node.child_count > 0) continue;
    const Drawable& finest = skeleton.drawables[node.first_drawable];
    for (uint32_t i = 0; i < finest.placement_count; ++i) {
      if (hidden && hidden->hides(finest.scene_node, i)) continue;
      const Placement& placement = skeleton.placements[finest.first_placement + i];
      const ChunkInfo& chunk = skeleton.chunks[placement.chunk];
      places.push_back({placement.chunk, placement.transform, vertices, indices});
      vertices += chunk.vertex_count;
      indices += uint64_t{3} * chunk.triangle_count;
    }
  }
  return places;
}

void put(const Skeleton& skeleton, const Poses* poses, const Chunk& chunk, const Place& place,
         FlatModel& model) {
  const Lattice& lattice = skeleton.lattices[skeleton.chunks[place.chunk].lattice];
  const Affine& always = skeleton.transforms[place.transform];
  const Affine affine = poses ? poses->transform(place.transform, always) : always;
  auto vertex = model.vertices.begin() + static_cast<std::ptrdiff_t>(place.first_vertex);
  for (size_t i = 0; i < chunk.vertices.size(); ++i) {
    const ChunkVertex& from = chunk.vertices[i];
    const glm::dvec3 position = affine * glm::dvec4(lattice.position(from.point), 1);
    *vertex++ = {glm::vec3((position - model.origin) / model.unit),
                 chunk.colors.empty() ? skeleton.palette[from.color] : chunk.colors[i]};
  }
  auto index = model.indices.begin() + static_cast<std::ptrdiff_t>(place.first_index);
  const auto first = static_cast<uint32_t>(place.first_vertex);
  for (const uint32_t corner : chunk.indices) *index++ = first + corner;
}

}  // namespace

FlatModelSize flat_model_size(const Skeleton& skeleton, const HiddenObjects* hidden) {
  FlatModelSize size;
  for (const Place& place : places_of_leaves(skeleton, hidden)) {
    size.vertices += skeleton.chunks[place.chunk].vertex_count;
    size.triangles += skeleton.chunks[place.chunk].triangle_count;
  }
  return size;
}

FlatModel flatten(const Pack& pack, const HiddenObjects* hidden, const Poses* poses) {
  const Skeleton& skeleton = pack.skeleton();
  const FlatModelSize size = flat_model_size(skeleton, hidden);
  if (size.vertices > std::numeric_limits<uint32_t>::max())
    fail(pack.name(), "{} vertices are more than one list of triangles can name", size.vertices);
  const Box box = skeleton.lattice().box(skeleton.scene_nodes[0].box);
  FlatModel model{.origin = center(box),
                  .unit = skeleton.lattice().step * 0x1p26,  // lattices have about 2^26 steps on a side
                  .vertices = std::vector<FlatVertex>(size.vertices),
                  .indices = std::vector<uint32_t>(3 * size.triangles)};

  // Chunk by chunk, so that each is read once however often it is placed.
  std::vector<Place> places = places_of_leaves(skeleton, hidden);
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return a.chunk < b.chunk; });
  std::vector<size_t> starts;
  for (size_t i = 0; i < places.size(); ++i) {
    if (i == 0 || places[i].chunk != places[i - 1].chunk) starts.push_back(i);
  }
  starts.push_back(places.size());
  parallel_for(starts.size() - 1, [&](size_t group) {
    const Chunk chunk = pack.read_chunk(places[starts[group]].chunk);
    for (size_t i = starts[group]; i < starts[group + 1]; ++i) put(skeleton, poses, chunk, places[i], model);
  });
  return model;
}

}  // namespace triptych
