// What a build places, and on which lattices: decided from boxes and counts alone, before any geometry is
// held.
#pragma once

#include "model/model.hpp"
#include "preprocess/build.hpp"
#include "preprocess/flat_colors.hpp"
#include "preprocess/textures/make_textures.hpp"
#include "scene/lattice.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace triptych {

/// Geometry that is stored once: a mesh on a lattice of its own with all its placements, or a mesh baked onto
/// the lattice of the hierarchy that it is in for the one placement that it has there.
struct PlannedMesh {
  uint32_t mesh = 0;                ///< index into Model::meshes
  bool baked = false;               ///< onto the lattice of its hierarchy
  uint32_t lattice = 0;             ///< index into BuildPlan::lattices
  Affine transform{1};              ///< what bakes it
  std::vector<uint32_t> instances;  ///< indices into BuildPlan::instances
  double stretch = 0;               ///< the largest of its placements in the model
  Box box;                          ///< of its triangles, in the space of its lattice
  uint64_t triangles = 0;
  bool has_colors = false;   ///< of vertices
  bool flat_colors = false;  ///< and they are those of whole triangles
};

/// A placement of a planned mesh.
struct PlannedInstance {
  uint32_t mesh = 0;       ///< index into BuildPlan::meshes
  uint32_t transform = 0;  ///< index into the transforms of its hierarchy
  uint32_t hierarchy = 0;  ///< index into BuildPlan::hierarchies
};

/// A placement of a sub-hierarchy.
struct PlannedSubHierarchy {
  uint32_t hierarchy = 0;  ///< index into BuildPlan::hierarchies, before the one that it is in
  uint32_t transform = 0;  ///< index into the transforms of the hierarchy that it is in
  /// What the source objects in it count from, itself counted from what those of the hierarchy count from.
  SourceObjectId first_object = no_id;
  /// Index into Motion::joints of what moves it, whose transform is that at time 0; no_id: it does not move.
  uint32_t joint = no_id;
};

struct PlannedHierarchy {
  std::vector<Affine> transforms;  ///< 0: the identity
  std::vector<double> stretches;   ///< for each transform its largest singular value
  std::vector<PlannedSubHierarchy> sub_hierarchies;
  uint32_t lattice = 0;  ///< index into BuildPlan::lattices
  uint64_t uses = 1;     ///< how many places it has in the model
  double stretch = 1;    ///< the largest of its placements in the model
  Box box;               ///< in its own space
};

struct BuildPlan {
  std::vector<PlannedMesh> meshes;
  std::vector<PlannedInstance> instances;  ///< by hierarchy
  /// For each instance its source object, counted as its hierarchy does; empty where the model has none.
  std::vector<SourceObjectId> objects;
  std::vector<PlannedHierarchy> hierarchies;  ///< sub-hierarchies, and last the model's own
  std::vector<Lattice> lattices;              ///< 0: the model's
  std::vector<DisplayColor> palette;
  std::vector<SurfaceMaterial> materials;  ///< Skeleton::materials
  std::vector<uint32_t> colors;            ///< for each material its palette index
  VertexTint tint;
  FlatColors flat_colors;
  uint64_t dropped_triangles = 0;     ///< of meshes that have no valid triangle
  std::vector<std::string> warnings;  ///< what streams found when they were read
  uint64_t left_out = 0;              ///< placements whose transform is not usable
  Motion motion;                      ///< the model's

  Palette palette_view() const { return {palette, materials}; }
  const Box& box() const { return hierarchies.back().box; }  ///< of the model
  /// Valid as long as the plan.
  MeshColors colors_of(const PlannedMesh& mesh) const;
  /// Whether vertices of any mesh keep colours of their own.
  bool has_vertex_colors() const;
};

/// A box that holds the placed sub-hierarchy's `box`, of its own space, in that of the hierarchy that it is
/// in, at all times. transforms: of that hierarchy.
Box box_at_all_times(const Motion& motion, const PlannedSubHierarchy& placed,
                     std::span<const Affine> transforms, const Box& box);

/// Reads every mesh that is placed once, for its box. Error for a model of which nothing can be placed.
/// textures: of the model's images; without them materials have none.
BuildPlan make_plan(const Model& model, const BuildOptions& options, const Textures& textures = {});

}  // namespace triptych
