#include "preprocess/build.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/notice.hpp"
#include "base/rounding.hpp"
#include "preprocess/build_hierarchy.hpp"
#include "preprocess/build_work.hpp"
#include "preprocess/contacts/find_contacts.hpp"
#include "preprocess/contacts/hold_contacts.hpp"
#include "preprocess/covered/make_room.hpp"
#include "preprocess/encode_objects.hpp"
#include "preprocess/layers/layer_facets.hpp"
#include "preprocess/light_stage.hpp"
#include "preprocess/node_drawables.hpp"
#include "preprocess/objects.hpp"
#include "preprocess/part_bodies.hpp"
#include "preprocess/parts.hpp"
#include "preprocess/placed_cache.hpp"
#include "scene/effects.hpp"
#include "scene/expand.hpp"
#include "scene/file_objects.hpp"

#include <algorithm>
#include <fmt/core.h>

namespace triptych {

namespace {

/// Appends to the arrays of a skeleton or a sub-hierarchy.
template <typename Hierarchy>
void add_nodes(Hierarchy& hierarchy, std::span<const HierarchyNode> nodes,
               std::vector<NodeContent> contents) {
  for (uint32_t i = 0; i < nodes.size(); ++i) {
    const NodeContent content = std::move(contents[i]);
    hierarchy.scene_nodes.push_back({content.box, nodes[i].parent, nodes[i].first_child, nodes[i].child_count,
                                     static_cast<DrawableId>(hierarchy.drawables.size()),
                                     static_cast<uint32_t>(content.drawables.size())});
    const auto first = static_cast<uint32_t>(hierarchy.placements.size());
    for (Drawable drawable : content.drawables) {
      drawable.scene_node = i;
      drawable.first_placement += first;
      hierarchy.drawables.push_back(drawable);
    }
    hierarchy.placements.insert(hierarchy.placements.end(), content.placements.begin(),
                                content.placements.end());
  }
}

/// All hierarchies of the model while they are built; indices as in Parts::hierarchies.
struct Hierarchies {
  std::vector<Objects> objects;
  std::vector<std::vector<HierarchyNode>> nodes;
  std::vector<HierarchyDrawables> drawables;

  void make_nodes(HierarchyKind kind) {
    for (const Objects& own : objects) {
      nodes.emplace_back();
      if (!own.extents.empty())
        nodes.back() = build_hierarchy(own.extents, kind, own.leaves, own.files, own.moving);
    }
  }

  /// For each hierarchy where its placed parts touch.
  std::vector<FoundContacts> contacts(const Parts& parts, const SpoolFile& geometry,
                                      const BuildOptions& options, const PlacedCache& kept) const {
    std::vector<FoundContacts> found;
    for (uint32_t i = 0; i < nodes.size(); ++i) {
      const PlacedParts& placed = parts.hierarchies[i];
      found.push_back(find_contacts(parts, placed, leaf_places(objects[i], nodes[i], placed.placed.size()),
                                    geometry, options.memory / 4, kept));
    }
    return found;
  }

  void make_drawables(const Parts& parts, std::span<const PartLevels> levels, const BuildOptions& options,
                      BuildWork& work, ImportReport& report) {
    uint64_t count = 0;
    for (const auto& own : nodes) count += own.size();
    Progress progress("hierarchical LODs", count);
    std::vector<HierarchyRoot> roots;
    for (uint32_t i = 0; i < nodes.size(); ++i) {
      drawables.push_back(make_node_drawables(parts, i, objects[i], nodes[i], levels, roots, options, work,
                                              progress, report));
      roots.push_back(drawables.back().root);
    }
  }

  /// The instances among the nodes of one hierarchy. `numbers`: for each hierarchy its number in the pack.
  std::vector<HierarchyInstance> instances_in(size_t hierarchy, const PlacedParts& placed,
                                              std::span<const uint32_t> numbers) const {
    std::vector<HierarchyInstance> instances;
    for (uint32_t i = 0; i < nodes[hierarchy].size(); ++i) {
      const uint32_t found = sub_hierarchy_of(nodes[hierarchy][i], objects[hierarchy]);
      if (found == no_id) continue;
      const PlannedSubHierarchy& inner = placed.sub_hierarchies[found];
      instances.push_back({i, numbers[inner.hierarchy], inner.transform, placed.stretches[inner.transform]});
    }
    return instances;
  }

  /// What moves of those.
  std::vector<StoredMotion::Instance> moving_in(size_t hierarchy, const PlacedParts& placed) const {
    std::vector<StoredMotion::Instance> moving;
    uint32_t instance = 0;
    for (const HierarchyNode& node : nodes[hierarchy]) {
      const uint32_t found = sub_hierarchy_of(node, objects[hierarchy]);
      if (found == no_id) continue;
      if (const uint32_t joint = placed.sub_hierarchies[found].joint; joint != no_id)
        moving.push_back({instance, joint});
      ++instance;
    }
    return moving;
  }

  /// Which placements of one hierarchy belong to which source object; the same numbers of local scene nodes
  /// and instances as in the pack.
  HierarchyObjects objects_in(size_t hierarchy, const PlacedParts& placed) const {
    HierarchyObjects found;
    std::vector<ObjectRun> runs;
    DrawableId first_drawable = 0;
    for (uint32_t i = 0; i < nodes[hierarchy].size(); ++i) {
      const HierarchyNode& node = nodes[hierarchy][i];
      const NodeContent& content = drawables[hierarchy].contents[i];
      for (uint32_t k = 0; k < content.triangle_objects.size(); ++k)
        found.add_drawable(first_drawable + k, content.triangle_objects[k]);
      first_drawable += static_cast<DrawableId>(content.drawables.size());
      if (const uint32_t inner = sub_hierarchy_of(node, objects[hierarchy]); inner != no_id)
        found.instances.push_back(placed.sub_hierarchies[inner].first_object);
      if (node.child_count > 0 || node.object >= objects[hierarchy].members.size()) continue;
      runs.clear();
      for (const uint32_t member : objects[hierarchy].members[node.object]) {  // each is a placement
        const SourceObjectId object = placed.objects[placed.placed[member].instance];
        if (runs.empty() || runs.back().object != object) runs.push_back({0, object});
        ++runs.back().placements;
      }
      const bool any = std::any_of(runs.begin(), runs.end(), [](auto& run) { return run.object != no_id; });
      if (any) found.add_leaf(i, runs);
    }
    return found;
  }

  /// The section OBJS; empty for a model without objects. Before move_to().
  std::vector<std::byte> encoded_objects(SourceObjects source, const Parts& parts) const {
    if (source.empty()) return {};
    StoredObjects stored{std::move(source), {}};
    stored.hierarchies.push_back(objects_in(nodes.size() - 1, parts.hierarchies.back()));
    for (size_t i = 0; i + 1 < nodes.size(); ++i) {
      if (!nodes[i].empty()) stored.hierarchies.push_back(objects_in(i, parts.hierarchies[i]));
    }
    return encode_objects(stored);
  }

  /// Moves the skeleton's content from here and from the parts into it.
  void move_to(StoredSkeleton& skeleton, Parts& parts) {
    ObjectCounts& counts = skeleton.surrounding.objects;
    std::vector<uint32_t> numbers;
    for (size_t i = 0; i < nodes.size(); ++i) {
      PlacedParts& placed = parts.hierarchies[i];
      const ObjectCounts& own = objects[i].counts;
      counts.initial += own.initial * placed.uses;
      counts.partition1 += own.partition1 * placed.uses;
      counts.clusters += own.clusters * placed.uses;
      counts.partition2 += own.partition2 * placed.uses;
      numbers.push_back(static_cast<uint32_t>(skeleton.sub_hierarchies.size()));
      std::vector<HierarchyInstance> instances = instances_in(i, placed, numbers);
      if (i + 1 == nodes.size()) {
        skeleton.instances = std::move(instances);
        skeleton.motion = {std::move(parts.motion), moving_in(i, placed)};
        if (!skeleton.motion.empty())
          skeleton.surrounding.effects.push_back(effect_name_in_pack(Effect::motion));
        skeleton.surrounding.transforms = std::move(placed.transforms);
        add_nodes(skeleton.surrounding, nodes[i], std::move(drawables[i].contents));
      } else if (!nodes[i].empty()) {  // empty ones, all of whose triangles were dropped, are not stored
        SubHierarchy& added = skeleton.sub_hierarchies.emplace_back();
        added.lattice = placed.lattice;
        added.transforms = std::move(placed.transforms);
        added.instances = std::move(instances);
        add_nodes(added, nodes[i], std::move(drawables[i].contents));
      }
    }
    skeleton.surrounding.lattices = std::move(parts.lattices);
    skeleton.surrounding.palette = std::move(parts.palette);
    skeleton.surrounding.materials = std::move(parts.materials);
  }
};

/// The text with file names without their folders, so that a model gives the same pack in every folder.
std::string without_folders(std::string text, const std::vector<std::filesystem::path>& files) {
  for (const std::filesystem::path& file : files) {
    const std::string whole = file.string(), name = file.filename().string();
    if (whole == name || name.empty()) continue;
    for (size_t at = 0; (at = text.find(whole, at)) != std::string::npos; at += name.size())
      text.replace(at, whole.size(), name);
  }
  return text;
}

/// Describes the expanded tree in the report. Error (file) if the pack could not be opened.
void describe_tree(const StoredSkeleton& stored, const std::filesystem::path& file, BuildReport& report) {
  report.sub_hierarchies = stored.sub_hierarchies.size();
  const auto describe = [&](const Skeleton& skeleton) {
    report.drawables = skeleton.drawables.size();
    report.levels = skeleton.levels();
    report.instances = skeleton.instances.size();
  };
  if (stored.instances.empty()) {
    describe(stored.surrounding);
  } else {
    describe(expand(stored, file.string()));
  }
}

BuildReport build(Model model, const BuildOptions& options, const std::filesystem::path& file) {
  if (model.source_triangles() == 0 || (model.instances.empty() && model.group_instances.empty()))
    fail(model.name(), "holds no triangles");
  // Units are as large as the memory allows: an earlier build's can only be reused if they were as large.
  BuildWork work(file, options.fingerprint.empty()
                           ? std::string()
                           : options.fingerprint + "\nunits of " + std::to_string(unit_triangles(options)));
  BuildReport report;
  report.resumed_units = work.left_to_replay();
  if (report.resumed_units > 0) notice("resuming: {} batches of work were done before", report.resumed_units);
  const auto stage = [&](const char* name, const auto& body) {
    const Stopwatch stopwatch;
    body();
    release_freed_memory();  // the next stage allocates pieces of other sizes
    report.stages.push_back({name, stopwatch.seconds()});
  };

  const std::vector<std::filesystem::path> files = model.files;
  StoredSkeleton stored;
  Skeleton& skeleton = stored.surrounding;
  skeleton.import = std::move(model.report);
  skeleton.source_triangles = model.source_triangles();
  skeleton.placed_triangles = model.placed_triangles();
  BuildPlan plan;
  Parts parts;
  Hierarchies hierarchies;
  std::vector<PartLevels> levels;
  SpoolFile texels(work.file("textures"));
  Textures textures;
  if (options.light.any()) {
    stage("light", [&] {
      textures = make_textures(model, texels);
      model = bake_light_in_build(std::move(model), options, textures, texels, work, report.light);
    });
  }
  stage("measure", [&] {
    if (!options.light.any()) textures = make_textures(model, texels);
    plan = make_plan(model, options, textures);
    skeleton.textures = std::move(textures.textures);
    skeleton.import.warnings.insert(skeleton.import.warnings.end(), textures.warnings.begin(),
                                    textures.warnings.end());
  });
  if (plan.has_vertex_colors()) skeleton.effects.push_back(effect_name_in_pack(Effect::vertex_colors));
  skeleton.import.dropped_triangles += plan.dropped_triangles;
  const auto transparent =
      static_cast<uint64_t>(std::count_if(plan.colors.begin(), plan.colors.end(), [&](uint32_t color) {
        return is_transparent(plan.palette[color]);
      }));
  if (transparent > 0) skeleton.effects.push_back(effect_name_in_pack(Effect::transparency));
  if (std::ranges::any_of(plan.materials, &SurfaceMaterial::is_textured))
    skeleton.effects.push_back(effect_name_in_pack(Effect::textures));
  if (std::ranges::any_of(plan.materials, &SurfaceMaterial::is_emissive))
    skeleton.effects.push_back(effect_name_in_pack(Effect::emission));
  if (report.light.baked) skeleton.effects.push_back(effect_name_in_pack(Effect::baked_light));
  if (report.light.ambient) skeleton.effects.push_back(effect_name_in_pack(Effect::ambient));
  skeleton.geo_place = model.geo_place;
  if (skeleton.geo_place) skeleton.effects.push_back(effect_name_in_pack(Effect::sky));
  auto& warnings = skeleton.import.warnings;
  const auto unseen = std::count_if(plan.colors.begin(), plan.colors.end(),
                                    [&](uint32_t color) { return plan.palette[color][3] == 0; });
  if (unseen > 0)
    warnings.push_back(std::to_string(unseen) +
                       " materials are wholly transparent, and do not show (--effects none draws them)");
  warnings.insert(warnings.end(), plan.warnings.begin(), plan.warnings.end());
  warnings.insert(warnings.end(), report.light.warnings.begin(), report.light.warnings.end());
  if (plan.left_out > 0) {
    skeleton.import.warnings.push_back(std::to_string(plan.left_out) +
                                       " placements left out: their transforms are beyond all bounds");
  }
  stage("weld and partition",
        [&] { parts = make_parts(model, std::move(plan), options, work, skeleton.import); });
  SourceObjects source_objects = std::move(model.source_objects);
  model = {};
  stage("cluster and partition", [&] {
    const bool several = file_objects(source_objects).size() > 1;
    hierarchies.objects =
        make_objects(parts, options, several ? files_of_objects(source_objects) : std::vector<uint32_t>());
  });
  stage("hierarchy", [&] { hierarchies.make_nodes(options.hierarchy); });
  const PlacedCache kept(options.cache, parts, work.parts());
  if (options.keeps_order())
    stage("covered", [&] { report.covered = make_room(parts, work.parts(), options.memory / 4, kept); });
  if (options.makes_layers()) {
    stage("layers", [&] { report.layers = make_layers(parts, work.parts(), options.memory / 4, kept); });
    if (report.layers.facets > 0) skeleton.effects.push_back(layers_effect);
  }
  if (options.holds_contacts()) {
    stage("contacts", [&] {
      report.contacts =
          hold_contacts(parts, hierarchies.contacts(parts, work.parts(), options, kept), work.parts());
    });
  }
  stage("leaf LODs",
        [&] { levels = make_part_levels(parts, options, exit_triangles(options), work, skeleton.import); });
  stage("HLODs", [&] { hierarchies.make_drawables(parts, levels, options, work, skeleton.import); });
  stage("write", [&] {
    for (std::string& warning : skeleton.import.warnings) warning = without_folders(warning, files);
    skeleton.closed = closed_surfaces_of(parts, levels, work.pack().chunks().size());
    levels = {};
    const std::vector<std::byte> objects = hierarchies.encoded_objects(std::move(source_objects), parts);
    hierarchies.move_to(stored, parts);
    parts = {};
    hierarchies = {};
    report.source_triangles = skeleton.source_triangles;
    report.placed_triangles = skeleton.placed_triangles;
    describe_tree(stored, file, report);
    report.import = skeleton.import;
    PackOptions said = options.said;
    for (const auto& [word, count] : {std::pair{"crowded-parts", uint64_t{report.contacts.crowded_parts}},
                                      std::pair{"crowded-planes", uint64_t{report.layers.crowded_parts}},
                                      std::pair{"transparent-materials", transparent}}) {
      if (!said.empty() && count > 0) said[word] = std::to_string(count);
    }
    if (!said.empty() && report.light.baked)
      said["light-white-lux"] = fmt::format("{:.4g}", report.light.white_lux);
    work.pack().finish(std::move(stored), objects, said, &texels);
  });
  report.pack_bytes = std::filesystem::file_size(file);
  return report;
}

}  // namespace

BuildReport build_pack(Model model, const BuildOptions& options, const std::filesystem::path& file) {
  return round_to_nearest([&] { return build(std::move(model), options, file); });
}

}  // namespace triptych
