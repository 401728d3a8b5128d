#include "base/signals.hpp"
#include "base/threads.hpp"
#include "launch/command.hpp"
#include "launch/named_files.hpp"
#include "launch/number_flags.hpp"
#include "launch/sample_folder.hpp"
#include "measure/json.hpp"
#include "samples/building/building.hpp"
#include "samples/effects/effects.hpp"
#include "samples/kit/kit.hpp"
#include "samples/plant/plant.hpp"
#include "samples/services/services.hpp"
#include "samples/surfaces/isosurface.hpp"
#include "samples/surfaces/statue.hpp"

#include <fmt/core.h>

namespace triptych {

namespace {

struct SampleCommand {
  BuildingOptions building;
  PlantOptions plant;
  ServicesOptions services;
  SurfaceOptions surface;
  int furniture = 0, repeat_storeys = 0;
  std::filesystem::path output, json;
  bool force = false;
};

int run_building(SampleCommand command) {
  if (command.furniture > 0) command.building.furniture = command.furniture;
  if (command.repeat_storeys > 0) command.building.repeat_storeys = command.repeat_storeys;
  const SampleReport report = make_building(command.building, command.output);
  for (const auto& [reason, count] : report.skipped_models)
    fmt::print("{} models skipped: {}\n", count, reason);
  fmt::print("{}: {} rooms, {} pieces of furniture of {} models, {} unique and {} placed triangles\n",
             (command.output / "scene.gltf").string(), report.rooms, report.placements,
             report.furniture_meshes, report.unique_triangles, report.placed_triangles);
  write_json(command.json, {{"rooms", report.rooms},
                            {"different_storeys", report.different_storeys},
                            {"placements", report.placements},
                            {"shell_placements", report.shell_placements},
                            {"furniture_meshes", report.furniture_meshes},
                            {"shell_meshes", report.shell_meshes},
                            {"unique_triangles", report.unique_triangles},
                            {"placed_triangles", report.placed_triangles},
                            {"skipped_models", report.skipped_models},
                            {"collapsed_triangles", report.collapsed_triangles},
                            {"undecoded_images", report.undecoded_images},
                            {"undefined_materials", report.undefined_materials},
                            {"transparent_materials", report.transparent_materials},
                            {"lights", report.lights},
                            {"dressing_placements", report.dressing_placements}});
  return 0;
}

int run_effects(const SampleCommand& command) {
  const EffectsReport report = make_effects(command.output);
  for (const EffectsFile& file : report.files)
    fmt::print("{:<40}{}{}\n", (command.output / file.name).string(), file.effects,
               file.build.empty() ? "" : fmt::format(", built with {}", file.build));
  fmt::print("{} objects, {} triangles in each\n", report.objects, report.triangles);
  nlohmann::json files = nlohmann::json::array();
  for (const EffectsFile& file : report.files)
    files.push_back({{"file", file.name}, {"effects", file.effects}, {"build", file.build}});
  write_json(command.json, {{"files", files}, {"objects", report.objects}, {"triangles", report.triangles}});
  return 0;
}

int run_kit(const SampleCommand& command) {
  const KitReport report = make_kit({.stop = stop_requested}, command.output);
  nlohmann::json files = nlohmann::json::array();
  for (const KitFile& file : report.files) {
    fmt::print("{:<40}{:>10} bytes, by {}\n", (command.output / file.name).string(), file.bytes, file.writer);
    files.push_back(
        {{"file", file.name}, {"format", file.format}, {"writer", file.writer}, {"bytes", file.bytes}});
  }
  fmt::print("{} solids in {} colours, {} triangles in each format\n", report.solids, report.colours,
             report.triangles);
  write_json(command.json, {{"files", files},
                            {"solids", report.solids},
                            {"colours", report.colours},
                            {"triangles", report.triangles}});
  return 0;
}

int run_plant(const SampleCommand& command) {
  const PlantReport report = make_plant(command.plant, command.output);
  fmt::print("{}: {} objects of {} to {} triangles, {} in all\n", (command.output / "scene.gltf").string(),
             report.objects, report.smallest_object, report.largest_object, report.triangles);
  write_json(command.json, {{"objects", report.objects},
                            {"triangles", report.triangles},
                            {"smallest_object", report.smallest_object},
                            {"largest_object", report.largest_object}});
  return 0;
}

nlohmann::json spread_json(const Spread& spread) {
  return {{"mean", spread.mean},
          {"p5", spread.p5},
          {"p50", spread.p50},
          {"p95", spread.p95},
          {"max", spread.max}};
}

int run_services(const SampleCommand& command) {
  const ServicesReport report = make_services(command.services, command.output);
  fmt::print("{}: {} objects of {} meshes in {} rooms, {} unique and {} placed triangles\n",
             (command.output / "scene.gltf").string(), report.objects, report.meshes, report.rooms,
             report.unique_triangles, report.placed_triangles);
  fmt::print("{:<22}{:>8}{:>8}{:>8}{:>8}{:>8}\n", "", "mean", "p5", "median", "p95", "max");
  for (const auto& [what, spread] : {std::pair{"triangles per object", report.triangles_per_object},
                                     {"uses per mesh", report.uses_per_mesh}})
    fmt::print("{:<22}{:>8.1f}{:>8}{:>8}{:>8}{:>8}\n", what, spread.mean, spread.p5, spread.p50, spread.p95,
               spread.max);
  fmt::print("{} meshes are used once\n", report.unshared_meshes);
  write_json(command.json, {{"objects", report.objects},
                            {"meshes", report.meshes},
                            {"unshared_meshes", report.unshared_meshes},
                            {"rooms", report.rooms},
                            {"unique_triangles", report.unique_triangles},
                            {"placed_triangles", report.placed_triangles},
                            {"triangles_per_object", spread_json(report.triangles_per_object)},
                            {"uses_per_mesh", spread_json(report.uses_per_mesh)}});
  return 0;
}

using MakeSurface = SurfaceReport (*)(const SurfaceOptions&, const std::filesystem::path&);

int run_surface(const SampleCommand& command, MakeSurface make) {
  const SurfaceReport report = make(command.surface, command.output);
  fmt::print("{}: {} triangles, {} vertices\n", (command.output / "scene.ply").string(), report.triangles,
             report.vertices);
  write_json(command.json, {{"triangles", report.triangles}, {"vertices", report.vertices}});
  return 0;
}

/// --json, --output, --triangles and --seed of a sample.
template <typename Options>
void add_sample_flags(CLI::App& app, SampleCommand& command, Options& options, uint64_t least,
                      uint64_t most) {
  add_common_flags(app, command.json);
  app.add_option("-o,--output", command.output, "Folder for the scene and the paths")
      ->required()
      ->type_name("DIR");
  app.add_option("--triangles", options.triangles, "About how many triangles in all")
      ->check(whole_number(least, most))
      ->capture_default_str();
  app.add_option("--seed", options.seed, "Decides everything that is random")
      ->check(whole_number(0))
      ->capture_default_str();
}

}  // namespace

void add_sample(CLI::App& app, Action& action) {
  CLI::App* sample = app.add_subcommand("sample", "Scenes that the program can make");
  sample->require_subcommand(1);
  sample->footer("Example: triptych sample building -o building --floors 2");
  auto command = std::make_shared<SampleCommand>();
  const auto runs = [command, &action](CLI::App& sub, const std::function<int(const SampleCommand&)>& run) {
    sub.add_flag("--force", command->force, "Overwrite files in the folder that no sample has made");
    sub.callback([=, &sub, &action] {
      action = [=, &sub] {
        if (!command->force)
          check_holds_only_samples(command->output,
                                   names_written_into(*sub.get_option("--output"), sub.get_name()));
        return run(*command);
      };
    });
  };
  CLI::App* building =
      sample->add_subcommand("building", "An office building, furnished with Debian's sweethome3d-furniture");
  building->footer("Example: triptych sample building -o building --floors 2 --seed 7");
  add_common_flags(*building, command->json);
  building->add_option("-o,--output", command->output, "Folder for scene.gltf and the paths")
      ->required()
      ->type_name("DIR");
  building->add_option("--floors", command->building.floors, "Storeys")
      ->check(whole_number(1, 100))
      ->capture_default_str();
  building
      ->add_option("--repeat-storeys", command->repeat_storeys,
                   "Storeys between the lowest and the highest repeat after so many (default: all differ)")
      ->check(whole_number(1, 100));
  building->add_option("--furniture", command->furniture, "Pieces of furniture (default: 2000 a floor)")
      ->check(whole_number(1, 1000000));
  building->add_flag("--effects", command->building.effects,
                     "With textures, glass, lamps that shine, curtains and pictures");
  building->add_option("--seed", command->building.seed, "Decides everything that is random")
      ->check(whole_number(0))
      ->capture_default_str();
  runs(*building, run_building);

  CLI::App* effects = sample->add_subcommand(
      "effects",
      "A small exhibition that calls for every effect, and the same with one of them, or with none");
  effects->footer("Example: triptych sample effects -o effects");
  add_common_flags(*effects, command->json);
  effects
      ->add_option("-o,--output", command->output,
                   "Folder for scene.gltf, plain.gltf and so on, and the paths")
      ->required()
      ->type_name("DIR");
  runs(*effects, run_effects);

  CLI::App* kit = sample->add_subcommand(
      "kit", "A small building in every format that a library here can write, the same in each");
  kit->footer("Example: triptych sample kit -o kit");
  add_common_flags(*kit, command->json);
  kit->add_option("-o,--output", command->output, "Folder for kit.gltf, kit.obj and so on, and the path")
      ->required()
      ->type_name("DIR");
  runs(*kit, run_kit);

  CLI::App* plant = sample->add_subcommand(
      "plant", "A coal-fired power plant: some 1,200 objects, among them one network of pipes");
  plant->footer("Example: triptych sample plant -o plant --triangles 1000000");
  add_sample_flags(*plant, *command, command->plant, min_plant_triangles, max_plant_triangles);
  runs(*plant, run_plant);

  CLI::App* services = sample->add_subcommand(
      "services", "A hospital full of ducts and pipes: some 30,000 small objects of shared meshes");
  services->footer("Example: triptych sample services -o services --storeys 2");
  add_common_flags(*services, command->json);
  services->add_option("-o,--output", command->output, "Folder for scene.gltf and the paths")
      ->required()
      ->type_name("DIR");
  services->add_option("--storeys", command->services.storeys, "Storeys, of about 10,000 objects each")
      ->check(whole_number(1, max_services_storeys))
      ->capture_default_str();
  services->add_option("--seed", command->services.seed, "Decides everything that is random")
      ->check(whole_number(0))
      ->capture_default_str();
  runs(*services, run_services);

  const auto add_surface = [&](const char* name, const char* does, MakeSurface make) {
    CLI::App* surface = sample->add_subcommand(name, does);
    surface->footer(fmt::format("Example: triptych sample {} -o {} --triangles 1000000", name, name));
    add_sample_flags(*surface, *command, command->surface, min_surface_triangles, max_surface_triangles);
    runs(*surface, [make](const SampleCommand& chosen) { return run_surface(chosen, make); });
  };
  add_surface("isosurface", "The surface between two gases that mix, with holes and depth", make_isosurface);
  add_surface("statue", "A robed figure: one closed, finely folded surface", make_statue);
}

}  // namespace triptych
