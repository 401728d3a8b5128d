#include "lod/build.hpp"

#include "base/memory.hpp"
#include "launch/command.hpp"
#include "measure/json.hpp"
#include "scene/import.hpp"

#include <fmt/core.h>

namespace triptych {

namespace {

struct BuildCommand {
  std::vector<std::filesystem::path> inputs;
  std::filesystem::path output, json;
};

int run(const BuildCommand& command) {
  const BuildReport report = build_pack(import_model(command.inputs), {}, command.output);
  nlohmann::json stages = nlohmann::json::array();
  for (const BuildStage& stage : report.stages)
    stages.push_back({{"name", stage.name}, {"seconds", stage.seconds}});
  for (const std::string& warning : report.import.warnings) fmt::print(stderr, "warning: {}\n", warning);
  fmt::print("{}: {} drawables, {} source and {} placed triangles, {:.1f} MB\n", command.output.string(),
             report.drawables, report.source_triangles, report.placed_triangles,
             static_cast<double>(report.pack_bytes) / 1e6);
  fmt::print("dropped triangles {}, welded vertices {}, repaired edges {}, stuck groups {}\n",
             report.import.dropped_triangles, report.import.welded_vertices, report.import.repaired_edges,
             report.import.stuck_groups);
  write_json(command.json, {{"source_triangles", report.source_triangles},
                            {"placed_triangles", report.placed_triangles},
                            {"drawables", report.drawables},
                            {"pack_bytes", report.pack_bytes},
                            {"peak_rss_bytes", peak_resident_bytes()},
                            {"stages", stages}});
  return 0;
}

}  // namespace

void add_build(CLI::App& app, Action& action) {
  auto command = std::make_shared<BuildCommand>();
  CLI::App* sub = app.add_subcommand("build", "Model files to a pack: glTF, GLB, OBJ, PLY, STL");
  sub->footer("Example: triptych build scene.gltf -o scene.tpk");
  add_common_flags(*sub, command->json);
  sub->add_option("input", command->inputs, "Model files; several become one model")
      ->required()
      ->type_name("INPUT");
  sub->add_option("-o,--output", command->output, "The pack to write")->required()->type_name("FILE.tpk");
  sub->callback([command, &action] { action = [command] { return run(*command); }; });
}

}  // namespace triptych
