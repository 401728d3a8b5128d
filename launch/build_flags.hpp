// The flags of every command that builds a pack.
#pragma once

#include "model/import/import.hpp"
#include "preprocess/build.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace triptych {

/// What to build, and how, by the command line.
struct BuildFlags {
  std::vector<std::filesystem::path> inputs;
  ImportOptions import;
  std::optional<Simplifier> simplifier;
  std::optional<Bound> bound;
  BuildOptions defaults;  ///< the other options, and the defaults of simplifier and bound
  bool bake_instances = false;

  BuildOptions options() const;
};

/// The inputs, --up, --unit, --simplifier, --bound, --memory, --bake-instances, --flat, --part-triangles,
/// --leaf-triangles, --hlod-triangles, --keep, --bake-light, --ambient, --light-samples and --light-bounces.
void add_build_flags(CLI::App& command, BuildFlags& flags);
/// --hierarchy.
void add_hierarchy_flag(CLI::App& command, BuildFlags& flags);

/// The flags of `build` in one text, as --build takes them, for these models. A usage error (--build) where
/// the text is none, or names a file.
BuildFlags parse_build_flags(const std::string& words, const std::vector<std::filesystem::path>& models);

/// Error (file) if one of the inputs is a pack, which says what to do with it.
void check_are_no_packs(const std::vector<std::filesystem::path>& inputs);
/// Error for a file with something else in it than a pack, which would be lost.
void check_may_become_pack(const std::filesystem::path& output);

/// Error (output) if it is a file of a model that is to be read, including files that the model refers to.
void check_is_no_model_file(const std::vector<std::filesystem::path>& outputs,
                            const std::vector<std::filesystem::path>& models);

/// The arguments that give the same flags to `triptych build` in another process, --hierarchy included.
std::vector<std::string> build_arguments(const BuildFlags& flags);

/// The flags that decide what is in the pack, --hierarchy included, by their names without dashes, each with
/// its value; "yes" or "no" of those without. Not the inputs, --memory, --threads.
PackOptions build_words(const BuildFlags& flags);

std::string name_of(Simplifier simplifier);
std::string name_of(Bound bound);
std::string name_of(HierarchyKind hierarchy);
/// As --keep takes it: "cover,touching", "none".
std::string name_of(const Kept& kept);

/// For BuildOptions::fingerprint: the program, the files by path, size and time of change, and every flag
/// that changes the pack. Error for a file that is gone.
std::string build_fingerprint(const BuildFlags& flags, const std::vector<std::filesystem::path>& files);

}  // namespace triptych
