// What a build places, and on which lattices: decided from boxes and counts alone, before any geometry is
// held.
#pragma once

#include "model/model.hpp"
#include "preprocess/build.hpp"
#include "scene/lattice.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace triptych {

/// Geometry that is stored once: a mesh on a lattice of its own with all its placements, or a mesh baked onto
/// the model's lattice for the one placement that it has.
struct PlannedMesh {
  uint32_t mesh = 0;                ///< index into Model::meshes
  uint32_t lattice = 0;             ///< 0: baked onto the model's
  Affine transform{1};              ///< what bakes it
  std::vector<uint32_t> instances;  ///< indices into BuildPlan::instances
  double stretch = 1;               ///< the largest of its placements
  Box box;                          ///< of its triangles, in the space of its lattice
  uint64_t triangles = 0;
};

/// A placement that counts.
struct PlannedInstance {
  uint32_t mesh = 0;       ///< index into BuildPlan::meshes
  uint32_t transform = 0;  ///< index into BuildPlan::transforms
};

struct BuildPlan {
  std::vector<PlannedMesh> meshes;
  std::vector<PlannedInstance> instances;
  std::vector<Affine> transforms;  ///< 0: the identity
  std::vector<double> stretches;   ///< for each transform its largest singular value
  std::vector<Lattice> lattices;   ///< 0: the model's
  std::vector<std::array<uint8_t, 4>> palette;
  std::vector<uint32_t> colors;       ///< for each material its palette index
  Box box;                            ///< of the model
  uint64_t dropped_triangles = 0;     ///< of meshes that have no other ones
  std::vector<std::string> warnings;  ///< what streams found when they were read
  uint64_t left_out = 0;              ///< placements with a transform that is beyond all bounds
};

/// Reads every mesh that is placed once, for its box. Error for a model of which nothing can be placed.
BuildPlan make_plan(const Model& model, const BuildOptions& options);

/// The factor by which the transform stretches lengths at most.
double largest_stretch(const Affine& transform);

}  // namespace triptych
