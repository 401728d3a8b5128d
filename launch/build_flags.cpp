#include "launch/build_flags.hpp"

#include "base/error.hpp"
#include "base/inject.hpp"
#include "launch/choice_flag.hpp"
#include "launch/import_flags.hpp"
#include "launch/named_files.hpp"
#include "launch/number_flags.hpp"
#include "preprocess/injected_rules.hpp"
#include "scene/pack_format.hpp"

#include <algorithm>
#include <fmt/core.h>
#include <fstream>
#include <map>

namespace triptych {

namespace {

constexpr uint64_t min_memory = uint64_t{128} << 20;
constexpr uint32_t min_triangles = 16, max_triangles = 1u << 24;

const std::map<std::string, Simplifier>& simplifiers() {
  static const std::map<std::string, Simplifier> names = {{"collapse", Simplifier::collapse},
                                                          {"openmesh", Simplifier::openmesh},
                                                          {"meshopt", Simplifier::meshopt}};
  return names;
}

const std::map<std::string, Bound>& bounds() {
  static const std::map<std::string, Bound> names = {{"fast", Bound::fast}, {"tight", Bound::tight}};
  return names;
}

const std::map<std::string, HierarchyKind>& hierarchies() {
  static const std::map<std::string, HierarchyKind> names = {
      {"pcp", HierarchyKind::partition_cluster_partition}, {"median_split", HierarchyKind::median_split}};
  return names;
}

/// The words of --keep.
const std::map<std::string, bool Kept::*>& promises() {
  static const std::map<std::string, bool Kept::*> names = {{"touching", &Kept::touching},
                                                            {"order", &Kept::order},
                                                            {"planes", &Kept::planes},
                                                            {"cover", &Kept::cover},
                                                            {"shade", &Kept::shade}};
  return names;
}

template <typename Value>
std::string name_in(const std::map<std::string, Value>& names, Value wanted) {
  for (const auto& [name, value] : names) {
    if (value == wanted) return name;
  }
  fail("build", "an option {} has no name", static_cast<int>(wanted));
}

void add_keep_flag(CLI::App& command, Kept& keep) {
  std::vector<std::string> words;
  for (const auto& [name, promise] : promises()) words.push_back(name);
  const std::string all = CLI::detail::join(words, ",");
  words.emplace_back("none");
  take_list(
      command.add_option_function<std::vector<std::string>>(
          "--keep",
          [&keep](const std::vector<std::string>& given) {
            const bool none = std::count(given.begin(), given.end(), "none") > 0;
            if (none && given.size() > 1) throw CLI::ValidationError("--keep", "none stands by itself");
            for (const auto& [name, promise] : promises())
              keep.*promise = std::count(given.begin(), given.end(), name) > 0;
          },
          "What levels of detail keep beside distances, at the price of triangles: that surfaces which touch "
          "show no gap (touching), that what lies right beneath a surface does not come out of it (order), "
          "that of surfaces in one plane the same one shows from everywhere "
          "(planes), "
          "that small things cover as much of the screen as in full detail (cover), that surfaces are shaded "
          "as "
          "in full detail (shade), or none"))
      ->check(one_of(words))
      ->type_name(all + "|none")
      ->default_str(name_of(keep));
}

void add_light_flags(CLI::App& command, LightOptions& light) {
  constexpr uint32_t most_samples = 1u << 16, most_bounces = 32;
  command.add_flag(
      "--bake-light", light.bake,
      "Bake the light of the model's lights, emissive surfaces and luminaires into its vertices; "
      "each placement then has a mesh of its own");
  command.add_flag("--ambient", light.ambient,
                   "Bake ambient occlusion into vertices: how open their surroundings are");
  command
      .add_option(
          "--light-samples", light.samples,
          "Of baked light and ambient occlusion: rays over the hemisphere of each vertex, for each bounce")
      ->check(whole_number(1, most_samples))
      ->capture_default_str();
  command
      .add_option("--light-bounces", light.bounces,
                  "Of baked light: how often it is reflected between surfaces")
      ->check(whole_number(0, most_bounces))
      ->capture_default_str();
}

/// Path, size and time of change.
std::string identity(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::path path = std::filesystem::canonical(file, error);
  const uint64_t size = error ? 0 : std::filesystem::file_size(path, error);
  const auto changed =
      error ? std::filesystem::file_time_type() : std::filesystem::last_write_time(path, error);
  if (error) fail(file.string(), "cannot be read: {}", error.message());
  return fmt::format("{}\n{} bytes, {}\n", path.string(), size, changed.time_since_epoch().count());
}

/// Whether the file begins as packs do.
bool is_pack(const std::filesystem::path& file) {
  std::array<char, pack_magic.size()> beginning{};
  std::ifstream(file, std::ios::binary).read(beginning.data(), beginning.size());
  return beginning == pack_magic;
}

}  // namespace

std::string name_of(Simplifier simplifier) { return name_in(simplifiers(), simplifier); }
std::string name_of(Bound bound) { return name_in(bounds(), bound); }
std::string name_of(HierarchyKind hierarchy) { return name_in(hierarchies(), hierarchy); }

std::string name_of(const Kept& kept) {
  std::string names;
  for (const auto& [name, promise] : promises()) {
    if (kept.*promise) names += (names.empty() ? "" : ",") + name;
  }
  return names.empty() ? "none" : names;
}

BuildOptions BuildFlags::options() const {
  BuildOptions options = defaults;
  if (simplifier) options.simplify.simplifier = *simplifier;
  if (bound) options.simplify.bound = *bound;
  options.share_instances = !bake_instances;
  options.rules = injected_build_rules();
  return options;
}

void add_build_flags(CLI::App& command, BuildFlags& flags) {
  command.add_option("input", flags.inputs, "Model files; several become one model")
      ->required()
      ->type_name("INPUT");
  add_import_flags(command, flags.import);
  const BuildOptions options = flags.options();
  add_choice_flag(command, "--simplifier", flags.simplifier, simplifiers(),
                  "The simplifier that makes levels of detail")
      ->default_str(name_of(options.simplify.simplifier));
  add_choice_flag(command, "--bound", flags.bound, bounds(),
                  "Where error bounds come from: the construction (fast), or a measurement (tight)")
      ->default_str(name_of(options.simplify.bound));
  command
      .add_option("--memory", flags.defaults.memory,
                  "The resident size that the build aims to stay below, at least 128M")
      ->transform(bytes_from(min_memory, "128M"))
      ->type_name("BYTES")
      ->default_str("1G");
  command.add_flag("--bake-instances", flags.bake_instances,
                   "Store the geometry of every placement, instead of sharing meshes");
  command.add_flag(
      "--flat", [&flags](int64_t) { flags.import.find_groups = false; },
      "Store groups that repeat in a scene once for each placement, instead of once in all");
  command
      .add_option("--part-triangles", flags.defaults.part_triangles, "Triangles of a part of a mesh, at most")
      ->check(whole_number(min_triangles, max_triangles))
      ->capture_default_str();
  command
      .add_option("--leaf-triangles", flags.defaults.leaf_triangles,
                  "Triangles of a leaf of the hierarchy, roughly")
      ->check(whole_number(min_triangles, max_triangles))
      ->capture_default_str();
  add_keep_flag(command, flags.defaults.keep);
  add_light_flags(command, flags.defaults.light);
  command
      .add_option("--hlod-triangles", flags.defaults.hlod_triangles,
                  "Triangles of an inner scene node's coarsest level, roughly")
      ->check(whole_number(min_triangles, max_triangles))
      ->capture_default_str();
}

void add_hierarchy_flag(CLI::App& command, BuildFlags& flags) {
  add_choice_flag(command, "--hierarchy", flags.defaults.hierarchy, hierarchies(),
                  "Partition, cluster, partition (pcp), or the original objects split at medians")
      ->default_str(name_of(flags.defaults.hierarchy));
}

BuildFlags parse_build_flags(const std::string& words, const std::vector<std::filesystem::path>& models) {
  BuildFlags flags;
  CLI::App build;
  build.set_help_flag();
  add_build_flags(build, flags);
  add_hierarchy_flag(build, flags);
  build.get_option("input")->required(false);
  try {
    build.parse(words);
  } catch (const CLI::ParseError& error) {
    throw CLI::ValidationError("--build", fmt::format("\"{}\": {}", words, error.what()));
  }
  if (!flags.inputs.empty())
    throw CLI::ValidationError("--build",
                               fmt::format("\"{}\" names a file: it takes flags of `build` alone", words));
  flags.inputs = models;
  return flags;
}

void check_are_no_packs(const std::vector<std::filesystem::path>& inputs) {
  for (const auto& input : inputs) {
    if (is_pack(input))
      fail(input.string(),
           "is a pack already: `triptych view` shows it and `triptych info` says what it was built of; "
           "`build` "
           "takes model files");
  }
}

void check_may_become_pack(const std::filesystem::path& output) {
  std::error_code error;
  if (std::filesystem::is_regular_file(output, error) && std::filesystem::file_size(output, error) > 0 &&
      !is_pack(output))
    fail(output.string(), "is no pack, and would be lost: name another file, or remove it");
}

void check_is_no_model_file(const std::vector<std::filesystem::path>& outputs,
                            const std::vector<std::filesystem::path>& models) {
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::path& output : outputs) {
    std::error_code error;
    if (!std::filesystem::exists(output, error))
      continue;  // nothing can be overwritten, so models need not be read
    if (files.empty()) files = files_of_models(models);
    check_is_none_of(output, files, "a file of the model");
  }
}

PackOptions build_words(const BuildFlags& flags) {
  const BuildOptions options = flags.options();
  PackOptions words = {{"bake-instances", flags.bake_instances ? "yes" : "no"},
                       {"bound", name_of(options.simplify.bound)},
                       {"flat", flags.import.find_groups ? "no" : "yes"},
                       {"hierarchy", name_of(options.hierarchy)},
                       {"hlod-triangles", std::to_string(options.hlod_triangles)},
                       {"keep", name_of(options.keep)},
                       {"leaf-triangles", std::to_string(options.leaf_triangles)},
                       {"part-triangles", std::to_string(options.part_triangles)},
                       {"simplifier", name_of(options.simplify.simplifier)}};
  const std::vector<std::string> import = import_arguments(flags.import);  // each a flag and its value
  for (size_t i = 0; i + 1 < import.size(); i += 2) words[import[i].substr(2)] = import[i + 1];
  const LightOptions& light = options.light;  // a pack without says nothing of it
  if (light.bake) words["bake-light"] = "yes";
  if (light.ambient) words["ambient"] = "yes";
  if (light.any()) {
    words["light-samples"] = std::to_string(light.samples);
    words["light-bounces"] = std::to_string(light.bounces);
  }
  return words;
}

std::vector<std::string> build_arguments(const BuildFlags& flags) {
  std::vector<std::string> arguments;
  for (const auto& input : flags.inputs) arguments.push_back(std::filesystem::absolute(input).string());
  for (const auto& [name, value] : build_words(flags)) {
    if (value == "no") continue;
    arguments.push_back("--" + name);
    if (value != "yes") arguments.push_back(value);
  }
  arguments.insert(arguments.end(), {"--memory", std::to_string(flags.options().memory)});
  return arguments;
}

std::string build_fingerprint(const BuildFlags& flags, const std::vector<std::filesystem::path>& files) {
  std::string fingerprint = "program " + identity("/proc/self/exe");
  for (const auto& file : files) fingerprint += "input " + identity(file);
  // The arguments name the inputs too: the same files in another order are another model. The memory limit
  // does not change the result.
  BuildFlags deciding = flags;
  deciding.defaults.memory = BuildOptions().memory;
  for (const std::string& argument : build_arguments(deciding)) fingerprint += argument + "\n";
  for (const std::string& fault : injected_names()) fingerprint += "--inject " + fault + "\n";
  return fingerprint;
}

}  // namespace triptych
