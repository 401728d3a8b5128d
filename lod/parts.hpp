// From the model to its parts: welded, on their lattices, partitioned once a mesh, placed as often as the
// mesh is.
#pragma once

#include "lod/build.hpp"
#include "scene/lattice.hpp"
#include "scene/model.hpp"
#include "scene/surface.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace triptych {

inline constexpr uint32_t no_border = 0xffffffffu;

/// A piece of a mesh after the first partition.
struct Part {
  Surface surface;
  /// For each point a number that it shares with the same point in the mesh's other parts, or no_border;
  /// empty where the part is all of its mesh.
  std::vector<uint32_t> borders;
  uint32_t lattice = 0;
};

/// A part under one of its mesh's placements.
struct PlacedPart {
  uint32_t part = 0, transform = 0, instance = 0;
};

struct Parts {
  std::vector<Part> parts;
  std::vector<PlacedPart> placed;       ///< by instance
  std::vector<uint32_t> border_counts;  ///< for each instance how many numbers its mesh's borders have
  std::vector<Affine> transforms;       ///< 0: the identity
  std::vector<double> stretches;        ///< for each transform its largest singular value
  std::vector<Lattice> lattices;        ///< 0: the model's
  std::vector<std::array<uint8_t, 4>> palette;
  uint64_t instances = 0;  ///< that were placed
};

/// A mesh that is placed once is baked onto the model's lattice; one that is placed more often gets a lattice
/// of its own. What is dropped is added to the report. Error for a model of which nothing is left. Takes the
/// meshes' memory.
Parts make_parts(Model& model, const BuildOptions& options, ImportReport& report);

/// The factor by which the transform stretches lengths at most.
double largest_stretch(const Affine& transform);

/// A lattice box, on the model's lattice, that holds the placed part.
LatticeBox placed_box(const Parts& parts, const PlacedPart& placed);

}  // namespace triptych
