#include "samples/building/building.hpp"

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/progress.hpp"
#include "base/threads.hpp"
#include "samples/building/dressing.hpp"
#include "samples/building/dressing_images.hpp"
#include "samples/building/shell.hpp"
#include "samples/building/storeys.hpp"
#include "samples/gltf_writer.hpp"

#include <algorithm>
#include <set>

namespace triptych {
namespace {

constexpr int furniture_a_floor = 2000;
constexpr double mean_triangles = 4300;
constexpr uint64_t max_unique_triangles = 2'700'000, min_unique_triangles = 150'000;

// Streams of random numbers.
enum : uint64_t { for_pools, for_plan, for_furniture, for_walk, for_spin, for_jump, for_dressing };

/// Reads the models that may be placed; those that cannot be read are left out and counted.
void read_pools(BuildingDesign& design, const RolePools& pools, bool shows_glass) {
  std::set<size_t> needed;
  for (const auto& pool : pools.pieces) needed.insert(pool.begin(), pool.end());
  const std::vector<size_t> pieces(needed.begin(), needed.end());
  std::vector<std::string> errors(pieces.size());
  design.meshes.resize(design.furniture.pieces.size());
  Progress progress("reading furniture", pieces.size());
  parallel_for(pieces.size(), [&](size_t i) {
    const FurniturePiece& piece = design.furniture.pieces[pieces[i]];
    try {
      design.meshes[pieces[i]] =
          read_furniture(piece, *design.furniture.catalogues[piece.catalogue].archive, shows_glass);
    } catch (const Error& error) {
      errors[i] = error.what();
    }
    progress.advance();
  });
  for (const auto& error : errors)
    if (!error.empty()) ++design.skipped_models[error];
  if (design.furniture.without_model > 0)
    design.skipped_models["no model in the archive"] = design.furniture.without_model;
}

using Json = nlohmann::ordered_json;

/// Writes creators and licences into the scene and into a text file.
void write_attribution(const BuildingDesign& design, const std::set<size_t>& used, GltfWriter& gltf,
                       const std::filesystem::path& folder) {
  std::string text =
      "The furniture comes from the catalogues of Sweet Home 3D (https://www.sweethome3d.com).\n";
  Json catalogues = Json::array(), models = Json::array();
  for (size_t number = 0; number < design.furniture.catalogues.size(); ++number) {
    const FurnitureCatalogue& catalogue = design.furniture.catalogues[number];
    catalogues.push_back({{"name", catalogue.name}, {"license", catalogue.license}});
    text += fmt::format("\n{}\n{}\n", catalogue.name, catalogue.license);
    for (const size_t i : used) {
      const FurniturePiece& piece = design.furniture.pieces[i];
      if (piece.catalogue != number) continue;
      models.push_back(
          {{"id", piece.id}, {"name", piece.name}, {"creator", piece.creator}, {"license", piece.license}});
      text += fmt::format("  {} ({}), by {}", piece.name, piece.model, piece.creator);
      text += piece.license == catalogue.license ? "\n" : fmt::format("; {}\n", piece.license);
    }
  }
  gltf.set_attribution(
      "Furniture by the creators named in asset.extras.models, under the licences named there",
      {{"catalogues", catalogues}, {"models", models}});
  write_file(folder / "ATTRIBUTION.txt", text);
}

uint64_t triangles_of(const std::vector<MeshPart>& parts) {
  uint64_t count = 0;
  for (const MeshPart& part : parts) count += part.indices.size() / 3;
  return count;
}

/// The placements, by storey, until all meshes are written.
class Scene {
 public:
  Scene(const BuildingDesign& design, SampleReport& report) : design_(design), report_(report) {}

  /// Returns how many places it has in the building.
  size_t place(std::string name, size_t mesh, const glm::dmat4& transform, std::optional<int> storey,
               uint64_t triangles) {
    nodes_.push_back({std::move(name), mesh, transform, storey});
    size_t times = 1;
    if (storey && !design_.storeys.empty())
      times = static_cast<size_t>(std::count(design_.storeys.begin(), design_.storeys.end(), *storey));
    report_.placed_triangles += triangles * times;
    return times;
  }

  void place_light(const LampLight& light) {
    lights_.push_back(light);
    report_.lights +=
        design_.storeys.empty() ? 1 : static_cast<size_t>(std::ranges::count(design_.storeys, light.storey));
  }

  void write(GltfWriter& gltf) const {
    std::optional<size_t> lamp;
    if (!lights_.empty()) lamp = gltf.add_point_light("lamp", lamp_colour, lamp_candela);
    for (const LampLight& light : lights_)
      if (design_.storeys.empty()) gltf.add_light_node(*lamp, light.position);
    for (const Node& node : nodes_) {
      if (design_.storeys.empty() || !node.storey) gltf.add_node(node.name, node.mesh, node.transform);
    }
    for (size_t floor = 0; floor < design_.storeys.size(); ++floor) {
      const int storey = design_.storeys[floor];
      const double above = floor_level(static_cast<int>(floor)) - floor_level(storey);
      const size_t parent = gltf.add_parent(fmt::format("storey {}", floor), {0, above, 0});
      for (const Node& node : nodes_) {
        if (node.storey == storey) gltf.add_node(node.name, node.mesh, node.transform, parent);
      }
      for (const LampLight& light : lights_)
        if (light.storey == storey) gltf.add_light_node(*lamp, light.position, parent);
    }
  }

 private:
  struct Node {
    std::string name;
    size_t mesh;
    glm::dmat4 transform;
    std::optional<int> storey;
  };
  const BuildingDesign& design_;
  SampleReport& report_;
  std::vector<Node> nodes_;
  std::vector<LampLight> lights_;
};

/// Returns how many places they have.
size_t write_objects(const std::vector<ShellObject>& objects, GltfWriter& gltf, Scene& scene,
                     SampleReport& report) {
  size_t placements = 0;
  for (const ShellObject& object : objects) {
    const size_t mesh = gltf.add_mesh(object.name, object.parts);
    const uint64_t triangles = triangles_of(object.parts);
    for (const auto& place : object.places)
      placements += scene.place(object.name, mesh, place, object.storey_of(place), triangles);
    ++report.shell_meshes;
    report.unique_triangles += triangles;
  }
  return placements;
}

void write_shell(const FloorPlan& plan, bool dressed, GltfWriter& gltf, Scene& scene, SampleReport& report) {
  std::vector<ShellObject> shell = make_shell(plan);
  if (dressed) dress_shell(shell);
  report.shell_placements = write_objects(shell, gltf, scene, report);
}

void write_dressing(const BuildingDesign& design, const Random& random, GltfWriter& gltf, Scene& scene,
                    SampleReport& report) {
  const Dressing dressing =
      make_dressing(design.plan, design.furniture, design.furnishing.placements, random);
  report.dressing_placements = write_objects(dressing.objects, gltf, scene, report);
  for (const LampLight& light : dressing.lights) scene.place_light(light);
}

std::set<size_t> write_furniture(const BuildingDesign& design, bool dressed, GltfWriter& gltf, Scene& scene,
                                 SampleReport& report) {
  std::map<size_t, size_t> numbers;
  std::set<size_t> used;
  Progress progress("placing furniture", design.furnishing.placements.size());
  for (const FurniturePlacement& placement : design.furnishing.placements) {
    const FurniturePiece& piece = design.furniture.pieces[placement.piece];
    const FurnitureMesh& mesh = design.meshes[placement.piece];
    progress.advance();
    if (dressed && is_ceiling_lamp(piece, placement)) continue;
    if (used.insert(placement.piece).second) {
      numbers[placement.piece] = gltf.add_mesh(piece.id, mesh.parts);
      ++report.furniture_meshes;
      report.unique_triangles += mesh.triangles;
      report.collapsed_triangles += mesh.collapsed_triangles;
      report.undecoded_images += mesh.undecoded_images;
      report.undefined_materials += mesh.undefined_materials;
      report.transparent_materials += mesh.transparent_materials;
    }
    const Room& room = design.plan.rooms[static_cast<size_t>(placement.room)];
    report.placements +=
        scene.place(fmt::format("{} {}: {}", room.name, room_type_name(room.type), piece.name),
                    numbers[placement.piece], placement_transform(placement), room.floor, mesh.triangles);
  }
  return used;
}

}  // namespace

BuildingDesign design_building(const BuildingOptions& options) {
  constexpr int max_furniture = 1'000'000;
  if (options.furniture && (*options.furniture < 0 || *options.furniture > max_furniture))
    fail("sample building", "{} pieces of furniture; 0 to {} can be placed", *options.furniture,
         max_furniture);
  if (options.repeat_storeys && *options.repeat_storeys < 1)
    fail("sample building", "storeys cannot repeat after {} different ones", *options.repeat_storeys);
  const Random random(options.seed);
  BuildingDesign design;
  int floors = options.floors;
  if (options.repeat_storeys && floors >= 1 && floors <= max_floors) {
    design.storeys = repeated_storeys(floors, *options.repeat_storeys);
    floors = different_storeys(design.storeys);
  }
  design.plan = make_floor_plan(floors, random.fork(for_plan));
  design.furniture = load_furniture(options.catalogues);
  auto wanted = static_cast<size_t>(options.furniture.value_or(furniture_a_floor * options.floors));

  // A small building has few models, so that it can be made, built and tested in seconds.
  const uint64_t budget = std::clamp<uint64_t>(wanted * 300, min_unique_triangles, max_unique_triangles);
  const size_t models = std::max<size_t>(60, wanted / 6);
  if (!design.storeys.empty())
    wanted = wanted * static_cast<size_t>(floors) / static_cast<size_t>(options.floors);
  const RolePools pools = choose_pools(design.furniture, budget, models, random.fork(for_pools));
  read_pools(design, pools, options.effects);
  std::vector<uint64_t> triangles;
  for (const FurnitureMesh& mesh : design.meshes) triangles.push_back(mesh.triangles);
  design.furnishing = furnish_building(design.furniture, pools, triangles, design.plan, wanted,
                                       mean_triangles, random.fork(for_furniture));
  FloorPlan plan = design.plan;
  std::vector<FurniturePlacement> placements = design.furnishing.placements;
  if (!design.storeys.empty()) {
    placements = repeat_placements(plan, placements, design.storeys);
    plan = repeat_plan(plan, design.storeys);
  }
  design.walk = make_walk(plan, placements, random.fork(for_walk));
  design.fly = make_fly(plan);
  design.spin = make_spin(plan, placements, random.fork(for_spin));
  design.jump = make_jump(plan, placements, random.fork(for_jump));
  return design;
}

SampleReport make_building(const BuildingOptions& options, const std::filesystem::path& folder) {
  const BuildingDesign design = design_building(options);
  SampleReport report;
  report.rooms = design.plan.rooms.size();
  report.different_storeys = design.plan.floors;
  if (!design.storeys.empty()) report.rooms = repeat_plan(design.plan, design.storeys).rooms.size();
  report.skipped_models = design.skipped_models;
  GltfWriter gltf(folder, "triptych sample building");
  Scene scene(design, report);
  write_shell(design.plan, options.effects, gltf, scene, report);
  const auto used = write_furniture(design, options.effects, gltf, scene, report);
  if (options.effects) {
    const Random random = Random(options.seed).fork(for_dressing);
    write_dressing(design, random, gltf, scene, report);
    write_dressing_images(folder, random);
  }
  scene.write(gltf);
  write_attribution(design, used, gltf, folder);
  gltf.finish();
  write_file(folder / "walk.json", path_json(design.walk));
  write_file(folder / "fly.json", path_json(design.fly));
  write_file(folder / "spin.json", path_json(design.spin));
  write_file(folder / "jump.json", path_json(design.jump));
  return report;
}

}  // namespace triptych
