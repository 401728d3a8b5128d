#include "scene/check_skeleton.hpp"

#include "base/error.hpp"
#include "scene/chunk.hpp"

#include <cmath>
#include <span>

namespace triptych {

namespace {

bool in_range(uint64_t first, uint64_t count, uint64_t size) {
  return first <= size && count <= size - first;
}

bool on_lattice(const LatticeBox& box) {
  for (int axis = 0; axis < 3; ++axis) {
    if (box.lo[axis] < -Lattice::limit || box.hi[axis] > Lattice::limit) return false;
  }
  return true;
}

/// The surrounding hierarchy or a sub-hierarchy.
struct HierarchyArrays {
  std::span<const SceneNode> scene_nodes;
  std::span<const Drawable> drawables;
  std::span<const Placement> placements;
  std::span<const Affine> transforms;
  std::span<const HierarchyInstance> instances;
};

template <typename Arrays>
HierarchyArrays hierarchy_of(const Arrays& arrays, std::span<const HierarchyInstance> instances) {
  return {arrays.scene_nodes, arrays.drawables, arrays.placements, arrays.transforms, instances};
}

/// `usable`: how many sub-hierarchies there are for its instances.
void check_instances(const HierarchyArrays& hierarchy, size_t usable, const std::string& place) {
  for (size_t i = 0; i < hierarchy.instances.size(); ++i) {
    const HierarchyInstance& instance = hierarchy.instances[i];
    const std::string here = fmt::format("{}: instance {}", place, i);
    if (instance.scene_node >= hierarchy.scene_nodes.size()) fail(here, "has no scene node");
    if (i > 0 && instance.scene_node <= hierarchy.instances[i - 1].scene_node)
      fail(here, "is not in the order of scene nodes");
    if (hierarchy.scene_nodes[instance.scene_node].child_count > 0) fail(here, "has children beside it");
    if (instance.sub_hierarchy >= usable) fail(here, "names a sub-hierarchy that is not before it");
    if (instance.transform >= hierarchy.transforms.size())
      fail(here, "names a transform that does not exist");
    if (!(instance.stretch >= 0) || !std::isfinite(instance.stretch)) fail(here, "has no stretch");
  }
}

void check_scene_nodes(const HierarchyArrays& hierarchy, const std::string& place) {
  const auto& nodes = hierarchy.scene_nodes;
  if (nodes.empty() || nodes[0].parent != no_id) fail(place, "has no root scene node");
  auto instance = hierarchy.instances.begin();
  for (size_t i = 0; i < nodes.size(); ++i) {
    const SceneNode& node = nodes[i];
    const std::string here = fmt::format("{}: scene node {}", place, i);
    if (i > 0 && node.parent >= i) fail(here, "comes before its parent");
    if (node.box.empty()) fail(here, "has an empty box");
    if (!on_lattice(node.box)) fail(here, "leaves the lattice");
    if (!in_range(node.first_drawable, node.drawable_count, hierarchy.drawables.size()))
      fail(here, "names drawables that do not exist");
    const bool is_instance = instance != hierarchy.instances.end() && instance->scene_node == i;
    if (is_instance) ++instance;
    if (node.child_count == 0 && node.drawable_count == 0 && !is_instance)
      fail(here, "is a leaf without a drawable");
    if (node.child_count == 0) continue;
    if (node.first_child <= i || !in_range(node.first_child, node.child_count, nodes.size()))
      fail(here, "names children that do not exist");
    for (uint32_t child = 0; child < node.child_count; ++child) {
      if (nodes[node.first_child + child].parent != i) fail(here, "names a child of another parent");
    }
  }
}

void check_drawables(const HierarchyArrays& hierarchy, std::span<const ChunkInfo> chunks,
                     const std::string& place) {
  for (size_t i = 0; i < hierarchy.placements.size(); ++i) {
    const Placement& placement = hierarchy.placements[i];
    if (placement.chunk >= chunks.size() || placement.transform >= hierarchy.transforms.size()) {
      fail(place, "placement {} names a chunk or a transform that does not exist", i);
    }
  }
  for (size_t i = 0; i < hierarchy.drawables.size(); ++i) {
    const Drawable& drawable = hierarchy.drawables[i];
    const std::string here = fmt::format("{}: drawable {}", place, i);
    if (!(drawable.error >= 0) || !std::isfinite(drawable.error)) fail(here, "has no error bound");
    if (drawable.scene_node >= hierarchy.scene_nodes.size()) fail(here, "belongs to no scene node");
    const SceneNode& node = hierarchy.scene_nodes[drawable.scene_node];
    if (i - node.first_drawable >= node.drawable_count) fail(here, "does not belong to its scene node");
    if (!in_range(drawable.first_placement, drawable.placement_count, hierarchy.placements.size()))
      fail(here, "names placements that do not exist");
    uint64_t triangles = 0;
    for (uint32_t placement = 0; placement < drawable.placement_count; ++placement)
      triangles += chunks[hierarchy.placements[drawable.first_placement + placement].chunk].triangle_count;
    if (triangles != drawable.triangles)
      fail(here, "claims {} triangles, but its chunks hold {}", drawable.triangles, triangles);
  }
}

void check_transforms(const HierarchyArrays& hierarchy, const std::string& place) {
  for (const Affine& transform : hierarchy.transforms) {
    for (int column = 0; column < 4; ++column) {
      const glm::dvec3& v = transform[column];
      if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z))
        fail(place, "has a transform that is not finite");
    }
  }
}

void check_hierarchy(const HierarchyArrays& hierarchy, std::span<const ChunkInfo> chunks,
                     const std::string& place) {
  check_transforms(hierarchy, place);
  check_scene_nodes(hierarchy, place);
  check_drawables(hierarchy, chunks, place);
}

void check_pieces(const Skeleton& skeleton, const std::string& place) {
  size_t end = skeleton.pieces.size();
  for (size_t i = skeleton.chunks.size(); i-- > 0;) {
    const ChunkInfo& chunk = skeleton.chunks[i];
    const std::string here = fmt::format("{}: chunk {}", place, i);
    if (chunk.first_piece > end) fail(here, "names pieces that do not exist");
    const size_t count = end - chunk.first_piece;
    if (count == 1 || count > max_chunk_pieces) fail(here, "has {} pieces", count);
    for (size_t piece = chunk.first_piece; piece < end; ++piece) {
      const LatticeBox& box = skeleton.pieces[piece];
      if (box.empty() || !chunk.box.contains(box)) fail(here, "has a piece outside its box");
    }
    end = chunk.first_piece;
  }
  if (end != 0) fail(place, "has pieces that belong to no chunk");
}

void check_chunks(const Skeleton& skeleton, uint64_t geometry_size, const std::string& place) {
  for (size_t i = 0; i < skeleton.chunks.size(); ++i) {
    const ChunkInfo& chunk = skeleton.chunks[i];
    const std::string here = fmt::format("{}: chunk {}", place, i);
    if (!in_range(chunk.offset, chunk.size, geometry_size)) fail(here, "leaves the geometry section");
    if (chunk.lattice >= skeleton.lattices.size()) fail(here, "names a lattice that does not exist");
    // A codec needs at least a byte for every 64 values: more is promised than the bytes can hold.
    if (chunk.vertex_count > chunk.size * 64 || chunk.triangle_count > chunk.size * 64)
      fail(here, "claims more than its bytes can hold");
    if (chunk.box.empty()) fail(here, "has an empty box");
    if (!on_lattice(chunk.box)) fail(here, "leaves the lattice");
  }
  for (const Lattice& lattice : skeleton.lattices) {
    const glm::dvec3& origin = lattice.origin;
    if (!(lattice.step > 0) || !std::isfinite(lattice.step + origin.x + origin.y + origin.z))
      fail(place, "has a lattice without a step");
  }
}

}  // namespace

void check_skeleton(const StoredSkeleton& stored, uint64_t geometry_size, const std::string& place,
                    const std::string& sub_place) {
  const Skeleton& skeleton = stored.surrounding;
  if (skeleton.lattices.empty() || skeleton.transforms.empty() || skeleton.palette.empty()) {
    fail(place, "has no lattice, no transform or no palette");
  }
  check_chunks(skeleton, geometry_size, place);
  check_pieces(skeleton, place);
  const HierarchyArrays surrounding = hierarchy_of(skeleton, stored.instances);
  check_instances(surrounding, stored.sub_hierarchies.size(), sub_place);
  check_hierarchy(surrounding, skeleton.chunks, place);
  for (size_t i = 0; i < stored.sub_hierarchies.size(); ++i) {
    const SubHierarchy& stored_hierarchy = stored.sub_hierarchies[i];
    const std::string here = fmt::format("{}: sub-hierarchy {}", sub_place, i);
    if (stored_hierarchy.lattice >= skeleton.lattices.size())
      fail(here, "names a lattice that does not exist");
    if (stored_hierarchy.transforms.empty() || stored_hierarchy.transforms[0] != Affine(1))
      fail(here, "does not begin its transforms with the identity");
    const HierarchyArrays hierarchy = hierarchy_of(stored_hierarchy, stored_hierarchy.instances);
    check_instances(hierarchy, i, here);
    check_hierarchy(hierarchy, skeleton.chunks, here);
  }
}

}  // namespace triptych
