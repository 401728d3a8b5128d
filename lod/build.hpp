// From a model to a pack: weld, partition-cluster-partition, hierarchy, LODs, HLODs.
#pragma once

#include "scene/model.hpp"
#include "scene/skeleton.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace triptych {

struct BuildOptions {
  /// Triangles of a part of a mesh after the first partition, at most; smaller parts cull better and cost
  /// more draws.
  uint32_t part_triangles = 8192;
  /// Placed triangles of a leaf of the hierarchy, roughly.
  uint32_t leaf_triangles = 16384;
  /// Triangles of an inner scene node's coarsest drawable, roughly.
  uint32_t hlod_triangles = 3000;
};

struct BuildStage {
  std::string name;
  double seconds = 0;
};

struct BuildReport {
  std::vector<BuildStage> stages;
  uint64_t source_triangles = 0, placed_triangles = 0, drawables = 0, pack_bytes = 0;
  ImportReport import;
};

/// Builds the pack; it appears under its name only when it is whole. The same model gives the same bytes for
/// any number of threads. Error for a model without a triangle.
BuildReport build_pack(Model model, const BuildOptions& options, const std::filesystem::path& file);

}  // namespace triptych
