#include "preprocess/build.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/notice.hpp"
#include "base/rounding.hpp"
#include "model/flatten.hpp"
#include "preprocess/build_hierarchy.hpp"
#include "preprocess/build_work.hpp"
#include "preprocess/node_drawables.hpp"
#include "preprocess/objects.hpp"
#include "preprocess/parts.hpp"

#include <fmt/core.h>

namespace triptych {

namespace {

void add_nodes(Skeleton& skeleton, std::span<const HierarchyNode> nodes, std::vector<NodeContent> contents) {
  for (uint32_t i = 0; i < nodes.size(); ++i) {
    const NodeContent content = std::move(contents[i]);
    skeleton.scene_nodes.push_back({content.box, nodes[i].parent, nodes[i].first_child, nodes[i].child_count,
                                    static_cast<DrawableId>(skeleton.drawables.size()),
                                    static_cast<uint32_t>(content.drawables.size())});
    const auto first = static_cast<uint32_t>(skeleton.placements.size());
    for (Drawable drawable : content.drawables) {
      drawable.scene_node = i;
      drawable.first_placement += first;
      skeleton.drawables.push_back(drawable);
    }
    skeleton.placements.insert(skeleton.placements.end(), content.placements.begin(),
                               content.placements.end());
  }
}

/// The text with names of files without their folders: the same model gives the same pack wherever it lies.
std::string without_folders(std::string text, const std::vector<std::filesystem::path>& files) {
  for (const std::filesystem::path& file : files) {
    const std::string whole = file.string(), name = file.filename().string();
    if (whole == name || name.empty()) continue;
    for (size_t at = 0; (at = text.find(whole, at)) != std::string::npos; at += name.size())
      text.replace(at, whole.size(), name);
  }
  return text;
}

BuildReport build(Model model, const BuildOptions& options, const std::filesystem::path& file) {
  model = flattened(std::move(model));
  if (model.source_triangles() == 0 || model.instances.empty()) fail(model.name(), "holds no triangles");
  // Units are as large as the memory lets them be: an earlier build's are the same only if they were as
  // large.
  BuildWork work(file, options.fingerprint.empty()
                           ? std::string()
                           : options.fingerprint + "\nunits of " + std::to_string(unit_triangles(options)));
  BuildReport report;
  report.resumed_units = work.left_to_replay();
  if (report.resumed_units > 0) notice("resuming: {} batches of work were done before", report.resumed_units);
  const auto stage = [&](const char* name, const auto& body) {
    const Stopwatch stopwatch;
    body();
    release_freed_memory();  // the next stage wants pieces of other sizes
    report.stages.push_back({name, stopwatch.seconds()});
  };

  const std::vector<std::filesystem::path> files = model.files;
  Skeleton skeleton;
  skeleton.import = std::move(model.report);
  skeleton.source_triangles = model.source_triangles();
  skeleton.placed_triangles = model.placed_triangles();
  BuildPlan plan;
  Parts parts;
  Objects objects;
  std::vector<HierarchyNode> nodes;
  std::vector<PartLevels> levels;
  std::vector<NodeContent> contents;
  stage("measure", [&] { plan = make_plan(model, options); });
  skeleton.import.dropped_triangles += plan.dropped_triangles;
  auto& warnings = skeleton.import.warnings;
  warnings.insert(warnings.end(), plan.warnings.begin(), plan.warnings.end());
  if (plan.left_out > 0) {
    skeleton.import.warnings.push_back(std::to_string(plan.left_out) +
                                       " placements left out: their transforms are beyond all bounds");
  }
  stage("weld and partition",
        [&] { parts = make_parts(model, std::move(plan), options, work, skeleton.import); });
  model = {};
  stage("cluster and partition", [&] { objects = make_objects(parts, options); });
  stage("hierarchy", [&] { nodes = build_hierarchy(objects.extents, options.hierarchy); });
  stage("leaf LODs",
        [&] { levels = make_part_levels(parts, options, exit_triangles(options), work, skeleton.import); });
  stage("HLODs", [&] {
    contents = make_node_drawables(parts, objects, nodes, levels, options, work, skeleton.import);
  });
  stage("write", [&] {
    skeleton.lattices = std::move(parts.lattices);
    skeleton.transforms = std::move(parts.transforms);
    skeleton.palette = std::move(parts.palette);
    skeleton.objects = objects.counts;
    for (std::string& warning : skeleton.import.warnings) warning = without_folders(warning, files);
    parts = {};
    levels = {};
    add_nodes(skeleton, nodes, std::move(contents));
    report.source_triangles = skeleton.source_triangles;
    report.placed_triangles = skeleton.placed_triangles;
    report.drawables = skeleton.drawables.size();
    report.levels = skeleton.levels();
    report.import = skeleton.import;
    work.pack().finish(std::move(skeleton));
  });
  report.pack_bytes = std::filesystem::file_size(file);
  return report;
}

}  // namespace

BuildReport build_pack(Model model, const BuildOptions& options, const std::filesystem::path& file) {
  return round_to_nearest([&] { return build(std::move(model), options, file); });
}

}  // namespace triptych
