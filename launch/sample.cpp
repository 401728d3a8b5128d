#include "base/threads.hpp"
#include "launch/command.hpp"
#include "measure/json.hpp"
#include "samples/building.hpp"

#include <fmt/core.h>

namespace triptych {

namespace {

struct SampleCommand {
  BuildingOptions building;
  int furniture = 0;
  std::filesystem::path output, json;
};

int run(SampleCommand command) {
  if (command.furniture > 0) command.building.furniture = command.furniture;
  const SampleReport report = make_building(command.building, command.output);
  for (const auto& [reason, count] : report.skipped_models)
    fmt::print("{} models skipped: {}\n", count, reason);
  fmt::print("{}: {} rooms, {} pieces of furniture of {} models, {} unique and {} placed triangles\n",
             (command.output / "scene.gltf").string(), report.rooms, report.placements,
             report.furniture_meshes, report.unique_triangles, report.placed_triangles);
  write_json(command.json, {{"rooms", report.rooms},
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
                            {"transparent_materials", report.transparent_materials}});
  return 0;
}

}  // namespace

void add_sample(CLI::App& app, Action& action) {
  CLI::App* sample = app.add_subcommand("sample", "Scenes that the program can make");
  sample->require_subcommand(1);
  sample->footer("Example: triptych sample building -o building --floors 2");
  auto command = std::make_shared<SampleCommand>();
  CLI::App* building =
      sample->add_subcommand("building", "An office building, furnished with Debian's sweethome3d-furniture");
  building->footer("Example: triptych sample building -o building --floors 2 --seed 7");
  add_common_flags(*building, command->json);
  building->add_option("-o,--output", command->output, "Folder for scene.gltf and the paths")
      ->required()
      ->type_name("DIR");
  building->add_option("--floors", command->building.floors, "Storeys")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  building->add_option("--furniture", command->furniture, "Pieces of furniture (default: 2000 a floor)")
      ->check(CLI::Range(1, 1000000));
  building->add_option("--seed", command->building.seed, "Decides everything that is random")
      ->capture_default_str();
  building->callback([command, &action] { action = [command] { return run(*command); }; });
}

}  // namespace triptych
