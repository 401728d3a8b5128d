// From the model to its parts: welded, on their lattices, partitioned once per mesh, placed as often as the
// mesh. The geometry lies in a spool file; what is here fits in memory.
#pragma once

#include "model/model.hpp"
#include "preprocess/build_work.hpp"
#include "preprocess/covered/closed_surface.hpp"
#include "preprocess/covered/error_gaps.hpp"
#include "preprocess/leaf_span.hpp"
#include "preprocess/part.hpp"
#include "preprocess/plan.hpp"
#include "scene/lattice.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace triptych {

/// A triangle in whose plane others lie, and its layer (scene/layers.hpp).
struct LayeredTriangle {
  uint32_t triangle = 0, layer = 0;
};

/// A triangle that levels leave out if they are off by its class's distance or more: within that distance of
/// what is not covered. Steps of the hierarchy's lattice.
struct CoveredTriangle {
  uint32_t triangle = 0, of_class = 0;
};

/// What is known of a part without its geometry.
struct PartInfo {
  SpoolPlace place;
  uint32_t lattice = 0, triangles = 0;
  uint32_t borders = 0;  ///< how many border points it has
  /// Steps by which its points may have been moved, so that no triangle vanishes and seams are closed.
  uint32_t moved = 0;
  /// Border points with these numbers and above belong only to its bucket: their numbers in the mesh are
  /// larger by own_borders_behind.
  uint32_t own_borders_from = 0, own_borders_behind = 0;
  /// Further points that its levels must hold, since others touch them in some of its placements; ascending,
  /// none of them is a border point.
  std::vector<uint32_t> contacts = {};
  /// The palette index of all of its triangles; no_id where they have several, or colours of vertices.
  uint32_t color = no_id;
  /// Whether backs are seen through any of its triangles.
  bool transparent = false;
  /// Triangles in whose planes others lie, ascending.
  std::vector<LayeredTriangle> layers = {};
  /// Of its mesh; none where that is not known.
  Outside outside = Outside::none;
  /// What its triangles begin with: what is closed (Division::runs). Bodies: below Parts::bodies.
  std::vector<PartRun> runs = {};
  /// Triangles that lie right beneath other surfaces in all placements (preprocess/covered/).
  std::vector<CoveredTriangle> covered = {};
  /// The step in which their classes count, in the units of its lattice's space: the longest of its
  /// placements' ones.
  double covered_step = 0;
  /// What its levels may not be off, in the same units.
  std::vector<ErrorGap> gaps = {};
  /// The same part with another chain of levels, whose finest one they share; no_id: none.
  uint32_t variant_of = no_id;
};

/// Only the part's border points, with their numbers in the mesh; ascending by points.
std::vector<BorderPoint> load_borders(const SpoolFile& file, const PartInfo& part);

/// A point of a placed part that touches others.
struct Contact {
  uint32_t placed = 0;  ///< index into PlacedParts::placed
  uint32_t point = 0;   ///< index into the points of its part
  LeafSpan span;        ///< of the leaves that the others are in
};

/// A part under one of its mesh's placements.
struct PlacedPart {
  uint32_t part = 0;
  uint32_t transform = 0;  ///< 0: on the lattice of the hierarchy that it is in
  uint32_t instance = 0;   ///< of those in the hierarchy
};

/// What is placed in one hierarchy, in its own space.
struct PlacedParts {
  std::vector<PlacedPart> placed;       ///< by instance
  std::vector<LatticeBox> boxes;        ///< of each placed part, on the hierarchy's lattice
  std::vector<Contact> contacts;        ///< by placed part and point; empty until they were looked for
  std::vector<uint32_t> border_counts;  ///< for each instance how many border points its mesh has
  std::vector<SourceObjectId> objects;  ///< for each instance, as BuildPlan::objects; empty as that
  std::vector<Affine> transforms;       ///< 0: the identity
  std::vector<double> stretches;        ///< for each transform its largest singular value
  std::vector<PlannedSubHierarchy> sub_hierarchies;
  uint32_t lattice = 0;    ///< index into Parts::lattices
  uint64_t instances = 0;  ///< that were placed
  uint64_t uses = 1;       ///< how many places the hierarchy has in the model
};

struct Parts {
  std::vector<PartInfo> parts;  ///< of all hierarchies
  /// Sub-hierarchies before those that they are in; the model's own last.
  std::vector<PlacedParts> hierarchies;
  std::vector<Lattice> lattices;  ///< 0: the model's
  std::vector<std::array<uint8_t, 4>> palette;
  std::vector<SurfaceMaterial> materials;  ///< Skeleton::materials
  uint32_t bodies = 0;                     ///< closed surfaces that are divided among parts
  bool has_objects = false;                ///< whether the model has source objects
  Motion motion;                           ///< of placed sub-hierarchies

  Palette palette_view() const { return {palette, materials}; }
};

/// Divides all meshes: a mesh, or a bucket of one, is a unit. What is dropped is added to the report. Error
/// for a model of which no triangle is left.
Parts make_parts(const Model& model, BuildPlan plan, const BuildOptions& options, BuildWork& work,
                 ImportReport& report);

}  // namespace triptych
