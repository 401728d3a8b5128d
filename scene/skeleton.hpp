// The hierarchy without geometry: scene nodes, drawables, placements, chunks. Always in memory.
#pragma once

#include "scene/affine.hpp"
#include "scene/box.hpp"
#include "scene/closed_surfaces.hpp"
#include "scene/geo_place.hpp"
#include "scene/import_report.hpp"
#include "scene/lattice.hpp"
#include "scene/surface_material.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace triptych {

struct MovingParts;

/// Names one scene node at one level of detail: the only name of geometry on the wire.
using DrawableId = uint32_t;
using SceneNodeId = uint32_t;
inline constexpr uint32_t no_id = 0xffffffffu;

/// A box of the AABB hierarchy, leaf or inner. Scene node 0 is the root; a parent's id is smaller than its
/// children's, and the children of one parent are contiguous. Leaves have no children and at least one
/// drawable.
struct SceneNode {
  LatticeBox box;  ///< on the model lattice; holds every vertex of its drawables and its children's boxes
  SceneNodeId parent = no_id;
  SceneNodeId first_child = 0;
  uint32_t child_count = 0;
  DrawableId first_drawable = 0;  ///< finest first; errors never shrink along them, nor towards the root
  uint32_t drawable_count = 0;
  bool operator==(const SceneNode&) const = default;
};

/// A scene node at one level of detail.
struct Drawable {
  double error = 0;  ///< proven bound of the two-sided distance to the source surface, model units (δ)
  SceneNodeId scene_node = 0;
  uint32_t first_placement = 0, placement_count = 0;
  uint32_t triangles = 0;  ///< of all its placements
  bool operator==(const Drawable&) const = default;
};

/// One chunk of geometry under one transform.
struct Placement {
  uint32_t chunk = 0;
  uint32_t transform = 0;  ///< index into Skeleton::transforms
  bool operator==(const Placement&) const = default;
};

/// Where a chunk of geometry lies in the pack, and what it holds.
struct ChunkInfo {
  uint64_t offset = 0, size = 0;  ///< bytes, from the start of the geometry section
  uint64_t checksum = 0;          ///< XXH3-64 of those bytes
  uint32_t vertex_count = 0, triangle_count = 0;
  uint32_t lattice = 0;      ///< index into Skeleton::lattices
  uint32_t first_piece = 0;  ///< index into Skeleton::pieces; its pieces end where the next chunk's begin
  LatticeBox box;            ///< of its vertices, on its lattice
  bool operator==(const ChunkInfo&) const = default;
};

/// How many objects there are after each step of partition-cluster-partition, as in the paper's table.
struct ObjectCounts {
  uint64_t initial = 0, partition1 = 0, clusters = 0, partition2 = 0;
  bool operator==(const ObjectCounts&) const = default;
};

/// A sub-hierarchy (scene/sub_hierarchy.hpp) in one of its places: an id in it is the first one plus the
/// local one.
struct ExpandedInstance {
  SceneNodeId scene_node = 0;        ///< the one that stands for it: the parent of its root
  SceneNodeId first_scene_node = 0;  ///< its root
  uint32_t scene_node_count = 0;     ///< without those of instances within it
  DrawableId first_drawable = 0;
  uint32_t drawable_count = 0;
  uint32_t sub_hierarchy = 0;
  uint32_t transform = 0;  ///< index into Skeleton::transforms: its space to the model's
  bool operator==(const ExpandedInstance&) const = default;
};

struct Skeleton {
  std::vector<SceneNode> scene_nodes;
  std::vector<Drawable> drawables;
  std::vector<Placement> placements;
  /// Lattice space of a chunk (as positions) to model space; 0 is the identity.
  std::vector<Affine> transforms;
  std::vector<Lattice> lattices;  ///< 0 is the model's
  std::vector<ChunkInfo> chunks;
  std::vector<LatticeBox> pieces;  ///< of chunks in several pieces: boxes of their vertices, piece by piece
  std::vector<std::array<uint8_t, 4>> palette;  ///< base colours, sRGB bytes, that vertices name by index
  std::vector<SurfaceMaterial> materials;   ///< of each of them, or empty where none has more than its colour
  std::vector<Texture> textures;            ///< that materials name by index
  std::vector<ExpandedInstance> instances;  ///< where sub-hierarchies were put, in the order of their ids
  uint32_t sub_hierarchies = 0;             ///< how many of them the pack holds
  /// For each chunk whether it is made to be seen from outside (scene/seen_from_outside.hpp); empty if none
  /// is.
  std::vector<bool> seen_from_outside;
  ClosedSurfaces closed;                      ///< what has cut surfaces
  std::shared_ptr<const MovingParts> moving;  ///< what moves (scene/moving_parts.hpp); null: nothing does
  uint64_t source_triangles = 0, placed_triangles = 0;
  ObjectCounts objects;
  ImportReport import;
  std::vector<std::string> effects;   ///< effects that the model calls for; empty for plain opaque models
  std::optional<GeoPlace> geo_place;  ///< where on Earth the model stands, where it is known

  const Lattice& lattice() const { return lattices[0]; }
  /// Boxes that hold the chunk's vertices, on its lattice: of its pieces, or the one of all of it.
  std::span<const LatticeBox> pieces_of(uint32_t chunk) const;
  uint32_t levels() const;  ///< the longest path from the root to a leaf, in scene nodes
  /// Length of the root box's diagonal, model units.
  double diagonal() const;
  /// The near plane where a path names none: small against each part of the model that stands alone, so that
  /// what lies far away does not move it. Depth keeps its precision however near it is. May look at every
  /// scene node: to be asked once.
  double default_near() const;
};

}  // namespace triptych
