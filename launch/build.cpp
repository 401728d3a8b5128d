#include "preprocess/build.hpp"

#include "base/build_cache.hpp"
#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/memory.hpp"
#include "base/notice.hpp"
#include "launch/build_flags.hpp"
#include "launch/command.hpp"
#include "launch/import_flags.hpp"
#include "launch/kept_build.hpp"
#include "launch/number_flags.hpp"
#include "launch/text_table.hpp"
#include "measure/json.hpp"
#include "model/import/import.hpp"
#include "model/import/kept_conversions.hpp"
#include "model/import/own_system.hpp"

#include <fmt/core.h>

namespace triptych {

namespace {

struct BuildCommand {
  BuildFlags flags;
  std::optional<uint64_t> cache_limit;
  std::filesystem::path output, json, cache;
};

/// What it says to a user; `report`: as report_json() made it.
void print(const nlohmann::json& report, const std::filesystem::path& output) {
  const auto count = [&](const char* key) { return report.at(key).get<uint64_t>(); };
  const nlohmann::json& import = report.at("import");
  const auto imported = [&](const char* key) { return import.at(key).get<uint64_t>(); };
  const auto warnings = import.at("warnings").get<std::vector<std::string>>();
  for (const std::string& warning : warnings) notice("warning: {}", warning);
  fmt::print("{}: {} drawables on {} levels, {} source and {} placed triangles, {} bytes\n", output.string(),
             count("drawables"), count("levels"), count("source_triangles"), count("placed_triangles"),
             in_threes(static_cast<double>(count("pack_bytes"))));
  fmt::print("dropped triangles {}, welded vertices {}, repaired edges {}, stuck groups {}, warnings {}\n",
             imported("dropped_triangles"), imported("welded_vertices"), imported("repaired_edges"),
             imported("stuck_groups"), warnings.size());
  if (count("covered_triangles") > 0) {
    fmt::print("{} triangles lie right beneath others: {} parts keep their distance, or leave them out\n",
               count("covered_triangles"), count("covering_parts"));
  }
  if (count("layered_facets") > 0) {
    fmt::print(
        "{} flat faces have others on them in their plane, in up to {} layers: those are drawn in front\n",
        count("layered_facets"), count("most_layers"));
  }
  if (count("crowded_planes") > 0) {
    fmt::print("{} parts overlap so many larger ones that not all faces in one plane were looked for\n",
               count("crowded_planes"));
  }
  if (count("contacts") > 0) {
    fmt::print(
        "{} parts touch others at {} places: their levels of detail hold those; {} more chains for "
        "placements "
        "that touch nothing\n",
        count("contact_parts"), count("contacts"), count("contact_chains"));
  }
  if (report.contains("light")) {
    const nlohmann::json& light = report.at("light");
    fmt::print(
        "{} gathered at {} points: {} triangles became {}, since light changes over them{}\n",
        light.at("baked").get<bool>() ? "light" : "ambient occlusion", light.at("points").get<uint64_t>(),
        light.at("triangles").get<uint64_t>(), light.at("refined_triangles").get<uint64_t>(),
        light.at("unshared_triangles").get<uint64_t>() > 0 ? "; placements of one mesh no longer share it"
                                                           : "");
  }
  if (count("crowded_parts") > 0) {
    fmt::print(
        "{} parts touch or overlap so many larger ones that not all places where they touch are held\n",
        count("crowded_parts"));
  }
}

/// The program that runs, by its content.
ContentKey this_program() {
  ContentKeyWriter writer;
  writer.write_all(std::span<const std::byte>(read_file("/proc/self/exe")));
  return writer.key();
}

/// What of a report holds for every build of the same model.
nlohmann::json report_json(const BuildReport& report, const BuildOptions& options,
                           const std::vector<std::filesystem::path>& files) {
  std::vector<std::string> names;
  for (const auto& file : files) names.push_back(file.string());
  nlohmann::json json = {{"source_triangles", report.source_triangles},
                         {"placed_triangles", report.placed_triangles},
                         {"drawables", report.drawables},
                         {"sub_hierarchies", report.sub_hierarchies},
                         {"instances", report.instances},
                         {"levels", report.levels},
                         {"pack_bytes", report.pack_bytes},
                         {"keep", name_of(options.keep)},
                         {"covered_triangles", report.covered.triangles},
                         {"covering_parts", report.covered.parts},
                         {"layered_facets", report.layers.facets},
                         {"layered_triangles", report.layers.triangles},
                         {"most_layers", report.layers.most},
                         {"crowded_planes", report.layers.crowded_parts},
                         {"contacts", report.contacts.contacts},
                         {"contact_parts", report.contacts.held_parts},
                         {"contact_chains", report.contacts.added_chains},
                         {"crowded_parts", report.contacts.crowded_parts},
                         {"files", names},
                         {"import", to_json(report.import)}};
  const LightReport& light = report.light;
  if (light.baked || light.ambient) {
    json["light"] = {{"baked", light.baked},
                     {"ambient", light.ambient},
                     {"lights", light.lights},
                     {"emissive_triangles", light.emissive_triangles},
                     {"luminaires", light.luminaires},
                     {"triangles", light.triangles},
                     {"refined_triangles", light.refined_triangles},
                     {"unshared_triangles", light.unshared_triangles},
                     {"points", light.points},
                     {"clipped_points", light.clipped_points},
                     {"white_lux", light.white_lux}};
  }
  return json;
}

/// Adds what this run took.
void add_run(nlohmann::json& report, const std::vector<BuildStage>& stages, uint64_t resumed_units,
             double seconds) {
  report["stages"] = nlohmann::json::array();
  for (const BuildStage& stage : stages)
    report["stages"].push_back({{"name", stage.name}, {"seconds", stage.seconds}});
  report["resumed_units"] = resumed_units;
  report["peak_rss_bytes"] = peak_resident_bytes();
  report["seconds"] = seconds;
}

/// The cache of a build, if it has one.
class UsedCache {
 public:
  explicit UsedCache(const BuildCommand& command) : file_(command.cache) {
    if (file_.empty()) return;
    cache_.emplace(file_, this_program(), command.cache_limit);
    build_.emplace(*cache_, command.flags);
    conversions_.emplace(*cache_, key_of_readers());
  }

  BuildCache* cache() { return cache_ ? &*cache_ : nullptr; }
  KeptConversions* conversions() { return conversions_ ? &*conversions_ : nullptr; }

  /// KeptBuild::take(); what there is in the cache then stays.
  std::optional<nlohmann::json> take(const std::filesystem::path& output) const {
    auto report = build_ ? build_->take(output) : std::nullopt;
    if (report) (*report)["cache"] = figures({1, 0});
    return report;
  }

  /// Puts in place what was taken from the cache and what was added to it, and the whole build. One that was
  /// resumed knows only the rest: then the file stays as it was. Returns figures.
  nlohmann::json end(const nlohmann::json& report, bool is_resumed, const std::filesystem::path& output) {
    try {
      if (!is_resumed) {
        build_->keep(report, output);
        cache_->commit();
      }
    } catch (const Error& error) {
      notice("warning: the cache stays as it was: {}", error.what());
    }
    const BuildCache::Count all = cache_->count();
    fmt::print("{}: {} of {} pieces of work were done before\n", file_.string(), all.found,
               all.found + all.made);
    if (cache_->left_out_bytes() > 0)
      notice("warning: {}: {} bytes of what this build asked for have no room within --cache-limit",
             file_.string(), in_threes(static_cast<double>(cache_->left_out_bytes())));
    return figures(all);
  }

 private:
  nlohmann::json figures(const BuildCache::Count& all) const {
    nlohmann::json kinds = nlohmann::json::object();
    for (const auto& [kind, count] : cache_->counts())
      kinds[kind] = {{"found", count.found}, {"made", count.made}};
    return {{"found", all.found},
            {"made", all.made},
            {"kinds", kinds},
            {"left_out_bytes", cache_->left_out_bytes()},
            {"bytes", std::filesystem::exists(file_) ? std::filesystem::file_size(file_) : 0}};
  }

  std::filesystem::path file_;
  std::optional<BuildCache> cache_;
  std::optional<KeptBuild> build_;
  std::optional<KeptConversions> conversions_;
};

int run(const BuildCommand& command) {
  check_are_no_packs(command.flags.inputs);
  check_is_no_model_file({command.output, command.json, command.cache}, command.flags.inputs);
  check_may_become_pack(command.output);
  const Stopwatch stopwatch;
  UsedCache kept(command);
  if (auto report = kept.take(command.output)) {
    print(*report, command.output);
    fmt::print("{}: nothing has changed since that pack was built\n", command.cache.string());
    add_run(*report, {{"copy", stopwatch.seconds()}}, 0, stopwatch.seconds());
    write_json(command.json, *report);
    return 0;
  }
  ImportOptions import = command.flags.import;
  import.temporary_folder = std::filesystem::absolute(command.output).parent_path();
  const uint64_t memory = command.flags.options().memory;
  keep_freed_memory_below(memory / 16);
  import.held_bytes = memory / 8;
  import.position_cache_bytes = memory / 16;
  import.kept_conversions = kept.conversions();
  Model model = import_model(command.flags.inputs, import);
  const double import_seconds = stopwatch.seconds();
  BuildOptions options = command.flags.options();
  options.said = build_words(command.flags);
  if (const auto system = own_system(command.flags.inputs, command.flags.import))
    say_system(*system, options.said);
  options.fingerprint = build_fingerprint(command.flags, model.files);
  const std::vector<std::filesystem::path> files = model.files;
  options.cache = kept.cache();
  const BuildReport report = build_pack(std::move(model), options, command.output);
  nlohmann::json json = report_json(report, options, files);
  const nlohmann::json for_every_build = json;
  const uint64_t peak = peak_resident_bytes();
  if (peak > options.memory) {
    json["import"]["warnings"].push_back(
        fmt::format("the build took {} MiB, more than --memory's {}", peak >> 20, options.memory >> 20));
  }
  print(json, command.output);
  if (kept.cache()) json["cache"] = kept.end(for_every_build, report.resumed_units > 0, command.output);
  std::vector<BuildStage> stages = {{"import", import_seconds}};
  stages.insert(stages.end(), report.stages.begin(), report.stages.end());
  add_run(json, stages, report.resumed_units, stopwatch.seconds());
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
  add_cache_limit(*sub, command->cache_limit,
                  "How large that cache may become: what earlier builds asked for stays as well, the latest "
                  "first (default: only what the last build asked for)")
      ->needs("--cache");
  sub->callback([command, &action] { action = [command] { return run(*command); }; });
}

}  // namespace triptych
