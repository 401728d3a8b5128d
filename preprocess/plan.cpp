#include "preprocess/plan.hpp"

#include "base/error.hpp"
#include "base/hashing.hpp"
#include "base/progress.hpp"
#include "base/threads.hpp"
#include "model/import/display_color.hpp"
#include "model/read_mesh.hpp"
#include "preprocess/federation.hpp"
#include "preprocess/placements.hpp"
#include "preprocess/strays.hpp"
#include "scene/file_objects.hpp"
#include "scene/transforms.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fmt/ranges.h>
#include <glm/glm.hpp>
#include <map>
#include <optional>

namespace triptych {

namespace {

/// The resolution of the lattices of hierarchies, and of meshes that are placed more than once.
constexpr int hierarchy_bits = 26, mesh_bits = 21;

bool finite(const Box& box) {
  const glm::dvec3 furthest = glm::max(glm::abs(box.lo), glm::abs(box.hi));
  return std::max({furthest.x, furthest.y, furthest.z}) < max_coordinate;
}

/// A colour of the palette, and what else it has.
struct PaletteEntry {
  DisplayColor color;
  SurfaceMaterial material = {};

  bool is_plain() const { return material == SurfaceMaterial(); }
  std::array<uint8_t, sizeof(color) + sizeof(material)> bytes() const {
    std::array<uint8_t, sizeof(color) + sizeof(material)> all;
    std::memcpy(all.data(), color.data(), sizeof(color));
    std::memcpy(all.data() + sizeof(color), &material, sizeof(material));
    return all;
  }
  bool operator<(const PaletteEntry& other) const { return bytes() < other.bytes(); }
};

PaletteEntry palette_entry(const Material& material, const Textures& textures) {
  PaletteEntry entry{display_color(material)};
  const auto texture_of = [&](uint32_t image) {
    return image < textures.of_images.size() ? textures.of_images[image] : ImageTexture();
  };
  SurfaceMaterial& own = entry.material;
  own.emission = {display_byte(material.emission.r), display_byte(material.emission.g),
                  display_byte(material.emission.b)};
  const ImageTexture base = texture_of(material.texture);
  own.texture = base.texture;
  own.emission_texture = texture_of(material.emission_texture).texture;
  if (!own.is_textured()) return entry;
  own.sampler = material.sampler;
  if (base.texture == no_id) return entry;
  const auto cutoff = static_cast<uint8_t>(std::clamp(std::ceil(material.cutoff * 255), 0.0f, 255.0f));
  if (base.least_alpha < cutoff) own.cutoff = cutoff;
  if (!material.blends) return entry;
  // Below 1 colours are transparent (scene/transparency.hpp): the texture says where they are not.
  constexpr uint8_t nearly_opaque = 254;
  own.alpha = entry.color[3];
  if (base.least_alpha < 255) entry.color[3] = std::min(entry.color[3], nearly_opaque);
  return entry;
}

/// Of each material of the model.
std::vector<PaletteEntry> palette_entries(const Model& model, const Textures& textures) {
  std::vector<PaletteEntry> entries;
  for (const Material& material : model.materials) entries.push_back(palette_entry(material, textures));
  return entries;
}

/// The box of the positions that triangles use, transformed, and which colours are those of whole triangles.
/// A flat colour has neither a texture nor light of its own: none is where materials, of these entries, do.
void measure(const Mesh& mesh, std::span<const PaletteEntry> materials, PlannedMesh& planned,
             std::optional<FlatColorSearch>& flat) {
  read_mesh(mesh, [&](std::span<const CornerTriangle> batch) {
    for (const CornerTriangle& triangle : batch) {
      for (const glm::dvec3& corner : triangle.corners)
        planned.box.extend(planned.transform * glm::dvec4(corner, 1));
      if (flat && !materials[triangle.material].is_plain()) flat.reset();
      if (flat) flat->add(triangle.colors, triangle.material);
    }
  });
}

/// Colours in the order of the materials, and then the flat ones. Of a model of several files, whose later
/// ones would be renumbered with each new colour of an earlier one, each has the place that its hash says, or
/// the next that is free, in a table with room to spare, which is as large for all models but those of very
/// many colours. of_materials: their entries.
void make_palette(const Model& model, std::span<const PaletteEntry> of_materials, BuildPlan& plan) {
  std::map<PaletteEntry, uint32_t> indices;
  for (const PaletteEntry& entry : of_materials) indices[entry] = no_id;
  for (const auto& [color, index] : plan.flat_colors) indices[PaletteEntry{color}] = no_id;
  if (indices.size() > max_colors) fail("build", "the model has more than {} colours", max_colors);
  const bool plain = std::ranges::all_of(of_materials, &PaletteEntry::is_plain);
  constexpr size_t room = 8, usual_places = 4096;
  const size_t places = std::max(std::bit_ceil(room * indices.size()), usual_places);
  const bool by_hash = file_objects(model.source_objects).size() > 1 && places <= max_colors;
  const auto hash_of = [](const PaletteEntry& entry) {
    return entry.is_plain() ? hash_values(std::span<const uint8_t>(entry.color))
                            : hash_values(std::span<const uint8_t>(entry.bytes()));
  };
  if (by_hash) plan.palette.resize(places);
  if (by_hash && !plain) plan.materials.resize(places);
  std::vector<uint8_t> taken(plan.palette.size(), 0);
  const auto index_of = [&](const PaletteEntry& entry) {
    uint32_t& index = indices[entry];
    if (index == no_id && by_hash) {
      index = static_cast<uint32_t>(hash_of(entry) % places);
      while (taken[index]) index = static_cast<uint32_t>((index + 1) % places);
      taken[index] = 1;
      plan.palette[index] = entry.color;
      if (!plain) plan.materials[index] = entry.material;
    } else if (index == no_id) {
      index = static_cast<uint32_t>(plan.palette.size());
      plan.palette.push_back(entry.color);
      if (!plain) plan.materials.push_back(entry.material);
    }
    return index;
  };
  for (const PaletteEntry& entry : of_materials) plan.colors.push_back(index_of(entry));
  for (auto& [color, index] : plan.flat_colors) index = index_of(PaletteEntry{color});
}

bool is_shareable(const Affine& transform, const BuildOptions& options) {
  return options.share_instances && well_conditioned(transform, options.rules.max_condition);
}

/// For each mesh the number of places that could share it.
std::vector<uint32_t> count_uses(const Model& model, std::span<const HierarchyPlacements> hierarchies,
                                 const BuildOptions& options) {
  std::vector<uint32_t> uses(model.meshes.size(), 0);
  for (const HierarchyPlacements& hierarchy : hierarchies) {
    hierarchy.each_instance([&](const Instance& instance) {
      if (is_finite(instance.transform) && is_shareable(instance.transform, options)) ++uses[instance.mesh];
    });
  }
  return uses;
}

/// Meshes, placements and transforms of all hierarchies; no boxes and lattices yet.
class Planner {
 public:
  Planner(const Model& model, const BuildOptions& options, BuildPlan& plan)
      : model_(model), options_(options), plan_(plan), shared_(model.meshes.size(), none) {}

  void run() {
    const std::vector<HierarchyPlacements> hierarchies = place_groups(model_, options_);
    const std::vector<uint32_t> uses = count_uses(model_, hierarchies, options_);
    for (const HierarchyPlacements& placements : hierarchies) {
      plan_.hierarchies.push_back({{}, {}, {}, 0, placements.uses, placements.stretch, {}});
      add_transform(Affine(1));
      placements.each_instance([&](const Instance& instance) {
        if (model_.meshes[instance.mesh].triangle_count() == 0) return;
        if (is_finite(instance.transform)) {
          add(instance, uses[instance.mesh] > 1);
        } else {
          plan_.left_out += placements.uses;
        }
      });
      for (const GroupInstance& instance : placements.groups) {
        const uint32_t transform = add_transform(instance.transform);
        PlannedHierarchy& hierarchy = plan_.hierarchies.back();
        hierarchy.sub_hierarchies.push_back(
            {instance.group, transform, instance.first_object, instance.joint});
        if (instance.joint != no_id && options_.rules.bounds_are_stretched)
          hierarchy.stretches[transform] = largest_stretch(model_.motion, instance.joint);
      }
    }
  }

 private:
  static constexpr uint32_t none = 0xffffffffu;

  uint32_t add_transform(const Affine& transform) {
    PlannedHierarchy& hierarchy = plan_.hierarchies.back();
    const bool identity = hierarchy.transforms.empty();
    hierarchy.transforms.push_back(transform);
    hierarchy.stretches.push_back(
        identity || !options_.rules.bounds_are_stretched ? 1 : largest_stretch(transform));
    return static_cast<uint32_t>(hierarchy.transforms.size() - 1);
  }

  void add(const Instance& instance, bool often) {
    PlannedInstance planned;
    planned.hierarchy = static_cast<uint32_t>(plan_.hierarchies.size() - 1);
    if (often && is_shareable(instance.transform, options_)) {
      planned.transform = add_transform(instance.transform);
      if (shared_[instance.mesh] == none) {
        shared_[instance.mesh] = static_cast<uint32_t>(plan_.meshes.size());
        plan_.meshes.push_back({instance.mesh, false, 0, Affine(1), {}, 0, {}, 0});
      }
      planned.mesh = shared_[instance.mesh];
    } else {
      planned.mesh = static_cast<uint32_t>(plan_.meshes.size());
      plan_.meshes.push_back({instance.mesh, true, 0, instance.transform, {}, 0, {}, 0});
    }
    const PlannedHierarchy& hierarchy = plan_.hierarchies.back();
    PlannedMesh& mesh = plan_.meshes[planned.mesh];
    mesh.triangles = model_.meshes[instance.mesh].triangle_count();
    mesh.stretch = std::max(mesh.stretch, hierarchy.stretch * hierarchy.stretches[planned.transform]);
    mesh.instances.push_back(static_cast<uint32_t>(plan_.instances.size()));
    plan_.instances.push_back(planned);
    if (!model_.source_objects.empty()) plan_.objects.push_back(instance.object);
  }

  const Model& model_;
  const BuildOptions& options_;
  BuildPlan& plan_;
  std::vector<uint32_t> shared_;  ///< for each mesh the planned one of all placements
};

/// Reads all that is placed: their boxes, and their flat colours.
void measure_meshes(const Model& model, std::span<const PaletteEntry> of_materials, BuildPlan& plan) {
  std::vector<std::optional<FlatColorSearch>> searches(plan.meshes.size());
  Progress progress("measuring meshes", plan.meshes.size());
  parallel_for(plan.meshes.size(), [&](size_t i) {
    PlannedMesh& mesh = plan.meshes[i];
    const Mesh& source = model.meshes[mesh.mesh];
    mesh.has_colors = source.has_colors();
    if (mesh.has_colors) searches[i].emplace(plan.tint);
    measure(source, of_materials, mesh, searches[i]);
    mesh.flat_colors = searches[i] && searches[i]->colors();
    progress.advance();
  });
  for (const std::optional<FlatColorSearch>& search : searches) {
    if (!search || !search->colors()) continue;
    for (const DisplayColor& color : *search->colors()) plan.flat_colors[color] = no_id;
  }
}

/// Boxes of hierarchies, and a lattice for each mesh that is placed more than once and each hierarchy.
void make_lattices(BuildPlan& plan) {
  plan.lattices.resize(1);
  for (PlannedMesh& mesh : plan.meshes) {
    if (mesh.box.empty()) plan.dropped_triangles += mesh.triangles;
    if (!mesh.box.empty() && !finite(mesh.box)) {
      for (const uint32_t instance : mesh.instances)
        plan.left_out += plan.hierarchies[plan.instances[instance].hierarchy].uses;
      mesh.box = {};
    }
    if (mesh.box.empty()) {
      mesh.triangles = 0;  // its placements stay in the plan, but are empty
      continue;
    }
    for (const uint32_t index : mesh.instances) {
      const PlannedInstance& instance = plan.instances[index];
      PlannedHierarchy& hierarchy = plan.hierarchies[instance.hierarchy];
      hierarchy.box.extend(placed_box(hierarchy.transforms[instance.transform], mesh.box));
    }
    if (mesh.baked) continue;
    mesh.lattice = static_cast<uint32_t>(plan.lattices.size());
    plan.lattices.push_back(make_lattice(mesh.box, mesh_bits));
  }
  for (PlannedHierarchy& hierarchy : plan.hierarchies) {
    for (const PlannedSubHierarchy& inner : hierarchy.sub_hierarchies) {
      const Box& box = plan.hierarchies[inner.hierarchy].box;
      if (!box.empty()) hierarchy.box.extend(box_at_all_times(plan.motion, inner, hierarchy.transforms, box));
    }
    if (&hierarchy == &plan.hierarchies.back()) {
      plan.lattices[0] = make_lattice(hierarchy.box, hierarchy_bits);
    } else if (!hierarchy.box.empty()) {
      hierarchy.lattice = static_cast<uint32_t>(plan.lattices.size());
      plan.lattices.push_back(make_lattice(hierarchy.box, hierarchy_bits));
    }
  }
  for (PlannedMesh& mesh : plan.meshes) {
    if (mesh.baked) mesh.lattice = plan.hierarchies[plan.instances[mesh.instances[0]].hierarchy].lattice;
  }
}

}  // namespace

MeshColors BuildPlan::colors_of(const PlannedMesh& mesh) const {
  return {colors, mesh.has_colors ? &tint : nullptr, mesh.flat_colors ? &flat_colors : nullptr, materials};
}

bool BuildPlan::has_vertex_colors() const {
  return std::ranges::any_of(meshes, [&](const PlannedMesh& mesh) { return colors_of(mesh).of_corners(); });
}

Box box_at_all_times(const Motion& motion, const PlannedSubHierarchy& placed,
                     std::span<const Affine> transforms, const Box& box) {
  return placed.joint == no_id ? placed_box(transforms[placed.transform], box)
                               : swept_box(motion, placed.joint, box);
}

BuildPlan make_plan(const Model& model, const BuildOptions& options, const Textures& textures) {
  BuildPlan plan;
  plan.motion = model.motion;
  plan.tint = VertexTint(model.materials);
  Planner(model, options, plan).run();
  const std::vector<PaletteEntry> of_materials = palette_entries(model, textures);
  measure_meshes(model, of_materials, plan);
  make_palette(model, of_materials, plan);
  for (const Mesh& mesh : model.meshes) {
    if (!mesh.stream) continue;
    const std::vector<std::string> warnings = mesh.stream->warnings();
    plan.warnings.insert(plan.warnings.end(), warnings.begin(), warnings.end());
  }
  make_lattices(plan);
  if (plan.box().empty()) {
    fail(model.name(), "holds no triangles{}{}", plan.warnings.empty() ? "" : ": ",
         fmt::join(plan.warnings, "; "));
  }
  const double extent = diagonal(plan.box());
  if (extent < min_extent)
    fail(model.name(), "is {} units large, which is less than numbers bear: give it other units", extent);
  if (const auto warning = stray_warning(model, plan)) plan.warnings.push_back(*warning);
  for (std::string& warning : federation_warnings(model, plan)) plan.warnings.push_back(std::move(warning));
  return plan;
}

}  // namespace triptych
