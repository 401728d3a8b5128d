// Which triangles belong to closed surfaces: those have cut surfaces where a section goes through what they
// hold. The section BODY; docs/pack-format.md describes every byte.
#pragma once

#include "scene/affine.hpp"
#include "scene/box.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace triptych {

struct ChunkInfo;
struct Placement;
struct SceneNode;
struct Skeleton;

/// Some triangles of a chunk.
struct ClosedRun {
  uint32_t chunk = 0;
  uint32_t first_triangle = 0, triangle_count = 0;
  uint32_t body = 0;  ///< index into ClosedSurfaces::bodies
  bool operator==(const ClosedRun&) const = default;
};

/// A closed surface that the build divided among chunks of one mesh, which are placed together.
struct DividedBody {
  LatticeBox box;  ///< on the lattice of its chunks
  uint32_t first_run = 0, run_count = 0;
  bool operator==(const DividedBody&) const = default;
};

/// Of what leaves show at full detail. A surface is closed if its triangles pass each edge as often one way
/// as the other: then each point that is not on it has a winding number, by which it is inside or not.
struct ClosedSurfaces {
  /// For each chunk how many of its first triangles are closed surfaces by themselves; empty if none are.
  std::vector<uint32_t> in_chunks;
  std::vector<DividedBody> bodies;
  std::vector<ClosedRun> runs;  ///< body by body; within a chunk they do not overlap

  bool empty() const { return in_chunks.empty() && bodies.empty(); }
  uint32_t in_chunk(uint32_t chunk) const { return in_chunks.empty() ? 0 : in_chunks[chunk]; }
  /// The runs in a chunk, as indices into `runs`.
  std::span<const uint32_t> runs_in(uint32_t chunk) const;
  /// Whether all of the chunk's triangles belong to closed surfaces.
  bool are_all_of(uint32_t chunk, const ChunkInfo& info) const;
  /// A box that holds the scene node, and the divided bodies that any of its leaves show a part of, on the
  /// model's lattice.
  const LatticeBox& reach(uint32_t scene_node, const SceneNode& node) const;

  /// What follows from the members above and an expanded skeleton.
  void find_reach(const Skeleton& skeleton);

 private:
  std::vector<uint32_t> first_in_chunk_, by_chunk_;  ///< runs_in()
  std::vector<LatticeBox> reach_;                    ///< for each scene node; empty without divided bodies
};

/// The section's bytes.
std::vector<std::byte> encode_closed_surfaces(const ClosedSurfaces& closed);
/// Without what find_reach() finds. Error (place, byte) for bytes that are no such section of a pack with
/// these chunks.
ClosedSurfaces decode_closed_surfaces(std::span<const std::byte> bytes, std::span<const ChunkInfo> chunks,
                                      const std::string& place);

/// A box of a divided body under the transform of a placement of one of its chunks, on the model's lattice.
LatticeBox placed_body(const Skeleton& skeleton, const DividedBody& body, const Affine& transform);

}  // namespace triptych
