// From a model to a pack: weld, partition-cluster-partition, hierarchy, LODs, HLODs.
#pragma once

#include "light/light_options.hpp"
#include "model/model.hpp"
#include "preprocess/build_hierarchy.hpp"
#include "preprocess/build_rules.hpp"
#include "preprocess/contacts/contact_report.hpp"
#include "preprocess/covered/covered_report.hpp"
#include "preprocess/layers/layer_report.hpp"
#include "scene/pack_options.hpp"
#include "scene/skeleton.hpp"
#include "simplify/simplify.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace triptych {

class BuildCache;

/// What levels of detail keep beside distances, at the price of triangles.
struct Kept {
  bool touching = true;  ///< surfaces that touch show no gap at any mix of levels
  bool order = true;     ///< what lies right beneath a surface does not come out of it
  bool planes = true;    ///< of surfaces in one plane the same one shows from everywhere
  bool cover = true;     ///< small things cover as much of the screen as in full detail
  bool shade = true;     ///< surfaces are shaded as in full detail
};

struct BuildOptions {
  /// Triangles of a part of a mesh after the first partition, at most; smaller parts cull better and cost
  /// more draws.
  uint32_t part_triangles = 4096;
  /// Placed triangles of a leaf of the hierarchy, roughly.
  uint32_t leaf_triangles = 4096;
  /// A mesh of more triangles is not held in memory: its triangles are sorted by place into files of about
  /// this many.
  uint32_t bucket_triangles = 1u << 18;
  /// Triangles of an inner scene node's coarsest drawable, roughly.
  uint32_t hlod_triangles = 32;
  HierarchyKind hierarchy = HierarchyKind::partition_cluster_partition;
  /// Whether chunks whose box is mostly air get several pieces with a box each; not with the plain median
  /// split.
  bool in_pieces() const { return hierarchy == HierarchyKind::partition_cluster_partition; }
  /// Simplifier and kind of bound; the other limits are the build's own.
  SimplifyLimits simplify = {};
  Kept keep = {};
  /// What light is baked into the vertices.
  LightOptions light = {};
  /// Off: the geometry of a mesh is stored once for each placement.
  bool share_instances = true;
  /// The resident size to aim at, bytes: it determines how much geometry is processed at a time. What is kept
  /// about each part grows with the model, whatever the limit. The result does not depend on it.
  uint64_t memory = uint64_t{1} << 30;
  /// Identifies the input and all options that change the result: a killed build is resumed if this is the
  /// same. Empty: it starts again.
  std::string fingerprint = {};
  /// What earlier builds made, by what they made it of; null: everything is made anew. The result does not
  /// depend on it.
  BuildCache* cache = nullptr;
  BuildRules rules = {};
  /// What the pack says of how it was built (section OPTS), beside what the build adds: "crowded-parts", how
  /// many parts do not hold all the places where they touch, and "crowded-planes", how many were not compared
  /// with all that may lie in their planes, where there are any. Empty: the pack says nothing.
  PackOptions said = {};
  SimplifyLimits simplify_limits() const {
    SimplifyLimits limits = simplify;
    limits.keep_cover = keep.cover;
    return limits;
  }
  bool keeps_order() const { return keep.order && rules.order_is_kept; }
  bool makes_layers() const { return keep.planes && rules.layers_are_told; }
  bool holds_contacts() const { return keep.touching && rules.contacts_hold; }
};

/// Triangles of one unit of work, all threads together.
inline uint64_t unit_triangles(const BuildOptions& options) {
  return std::clamp<uint64_t>(options.memory >> 10, 1u << 16, 1u << 20);
}

struct BuildStage {
  std::string name;
  double seconds = 0;
};

struct BuildReport {
  std::vector<BuildStage> stages;
  uint64_t source_triangles = 0, placed_triangles = 0, drawables = 0, pack_bytes = 0;
  /// Groups that are stored once, and how many places they have.
  uint64_t sub_hierarchies = 0, instances = 0;
  uint32_t levels = 0;  ///< of the hierarchy: the longest path from its root to a leaf
  ContactReport contacts;
  LayerReport layers;
  CoveredReport covered;
  LightReport light;
  uint64_t resumed_units = 0;  ///< batches of units that an earlier, killed build had completed
  ImportReport import;
};

/// Builds the pack; it appears under its name only when it is complete. The same model gives the same bytes
/// for any number of threads, and whether or not the build was killed and resumed. What does not fit in
/// memory lies in the folder `FILE.work` while the build runs. Error for a model without a triangle.
BuildReport build_pack(Model model, const BuildOptions& options, const std::filesystem::path& file);

}  // namespace triptych
