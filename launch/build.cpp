#include "preprocess/build.hpp"

#include "base/build_cache.hpp"
#include "base/clock.hpp"
#include "base/memory.hpp"
#include "base/notice.hpp"
#include "launch/build_flags.hpp"
#include "launch/command.hpp"
#include "launch/import_flags.hpp"
#include "launch/text_table.hpp"
#include "measure/json.hpp"
#include "model/import/import.hpp"
#include "model/import/own_system.hpp"

#include <fmt/core.h>

namespace triptych {

namespace {

struct BuildCommand {
  BuildFlags flags;
  std::filesystem::path output, json, cache;
};

void print(const BuildReport& report, const std::filesystem::path& output) {
  for (const std::string& warning : report.import.warnings) notice("warning: {}", warning);
  fmt::print("{}: {} drawables on {} levels, {} source and {} placed triangles, {} bytes\n", output.string(),
             report.drawables, report.levels, report.source_triangles, report.placed_triangles,
             in_threes(static_cast<double>(report.pack_bytes)));
  fmt::print("dropped triangles {}, welded vertices {}, repaired edges {}, stuck groups {}, warnings {}\n",
             report.import.dropped_triangles, report.import.welded_vertices, report.import.repaired_edges,
             report.import.stuck_groups, report.import.warnings.size());
  if (report.covered.triangles > 0) {
    fmt::print("{} triangles lie right beneath others: {} parts keep their distance, or leave them out\n",
               report.covered.triangles, report.covered.parts);
  }
  if (report.layers.facets > 0) {
    fmt::print(
        "{} flat faces have others on them in their plane, in up to {} layers: those are drawn in front\n",
        report.layers.facets, report.layers.most);
  }
  if (report.layers.crowded_parts > 0) {
    fmt::print("{} parts overlap so many larger ones that not all faces in one plane were looked for\n",
               report.layers.crowded_parts);
  }
  if (report.contacts.contacts > 0) {
    fmt::print(
        "{} parts touch others at {} places: their levels of detail hold those; {} more chains for "
        "placements "
        "that touch nothing\n",
        report.contacts.held_parts, report.contacts.contacts, report.contacts.added_chains);
  }
  if (report.contacts.crowded_parts > 0) {
    fmt::print(
        "{} parts touch or overlap so many larger ones that not all places where they touch are held\n",
        report.contacts.crowded_parts);
  }
}

/// The program that runs, by its content.
ContentKey this_program() {
  ContentKeyWriter writer;
  writer.write_all(std::span<const std::byte>(read_file("/proc/self/exe")));
  return writer.key();
}

/// What was taken from the cache and what was added to it, which is put in place. A build that was resumed
/// knows only the rest: then the file stays as it was.
nlohmann::json end_cache(BuildCache& cache, const std::filesystem::path& file, const BuildReport& report) {
  const uint64_t all = cache.found() + cache.made();
  fmt::print("{}: {} of {} pieces of work were done before\n", file.string(), cache.found(), all);
  if (report.resumed_units == 0) cache.commit();
  return {{"found", cache.found()},
          {"made", cache.made()},
          {"bytes", std::filesystem::exists(file) ? std::filesystem::file_size(file) : 0}};
}

nlohmann::json report_json(const BuildReport& report, const BuildOptions& options,
                           const std::vector<std::filesystem::path>& files, double seconds) {
  nlohmann::json stages = nlohmann::json::array(), names = stages;
  for (const auto& file : files) names.push_back(file.string());
  for (const BuildStage& stage : report.stages)
    stages.push_back({{"name", stage.name}, {"seconds", stage.seconds}});
  return {{"source_triangles", report.source_triangles},
          {"placed_triangles", report.placed_triangles},
          {"drawables", report.drawables},
          {"sub_hierarchies", report.sub_hierarchies},
          {"instances", report.instances},
          {"levels", report.levels},
          {"pack_bytes", report.pack_bytes},
          {"peak_rss_bytes", peak_resident_bytes()},
          {"keep", name_of(options.keep)},
          {"covered_triangles", report.covered.triangles},
          {"covering_parts", report.covered.parts},
          {"layered_facets", report.layers.facets},
          {"layered_triangles", report.layers.triangles},
          {"most_layers", report.layers.most},
          {"contacts", report.contacts.contacts},
          {"contact_parts", report.contacts.held_parts},
          {"contact_chains", report.contacts.added_chains},
          {"resumed_units", report.resumed_units},
          {"seconds", seconds},
          {"stages", stages},
          {"files", names},
          {"import", to_json(report.import)}};
}

int run(const BuildCommand& command) {
  check_are_no_packs(command.flags.inputs);
  check_is_no_model_file({command.output, command.json, command.cache}, command.flags.inputs);
  check_may_become_pack(command.output);
  const Stopwatch stopwatch;
  ImportOptions import = command.flags.import;
  import.temporary_folder = std::filesystem::absolute(command.output).parent_path();
  const uint64_t memory = command.flags.options().memory;
  keep_freed_memory_below(memory / 16);
  import.held_bytes = memory / 8;
  import.position_cache_bytes = memory / 16;
  std::optional<BuildCache> cache;
  if (!command.cache.empty()) cache.emplace(command.cache, this_program());
  Model model = import_model(command.flags.inputs, import);
  const double import_seconds = stopwatch.seconds();
  BuildOptions options = command.flags.options();
  options.said = build_words(command.flags);
  if (const auto system = own_system(command.flags.inputs, command.flags.import))
    say_system(*system, options.said);
  options.fingerprint = build_fingerprint(command.flags, model.files);
  const std::vector<std::filesystem::path> files = model.files;
  if (cache) options.cache = &*cache;
  BuildReport report = build_pack(std::move(model), options, command.output);
  report.stages.insert(report.stages.begin(), {"import", import_seconds});
  const uint64_t peak = peak_resident_bytes();
  if (peak > options.memory) {
    report.import.warnings.push_back(
        fmt::format("the build took {} MiB, more than --memory's {}", peak >> 20, options.memory >> 20));
  }
  print(report, command.output);
  nlohmann::json json = report_json(report, options, files, stopwatch.seconds());
  if (cache) json["cache"] = end_cache(*cache, command.cache, report);
  write_json(command.json, json);
  return 0;
}

}  // namespace

void add_build(CLI::App& app, Action& action) {
  auto command = std::make_shared<BuildCommand>();
  CLI::App* sub =
      app.add_subcommand("build", "Build a pack from model files: glTF, GLB, OBJ, PLY, STL and more");
  sub->footer(format_help() + "\nExample: triptych build scene.gltf -o scene.tpk");
  add_common_flags(*sub, command->json);
  add_build_flags(*sub, command->flags);
  add_hierarchy_flag(*sub, command->flags);
  sub->add_option("-o,--output", command->output, "The pack to write")->required()->type_name("FILE.tpk");
  sub->add_option(
         "--cache", command->cache,
         "Keep what this build makes, and take from there what an earlier one made of the same parts")
      ->type_name("FILE");
  sub->callback([command, &action] { action = [command] { return run(*command); }; });
}

}  // namespace triptych
