// What the commands that show something are given: a pack, or model files, of which they build one by
// themselves.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace triptych {

struct ShownModel {
  std::vector<std::filesystem::path> files;  ///< one pack, or model files that become one model
  std::string build;                         ///< flags of `build`, in one text
  std::optional<uint64_t> cache_limit{};     ///< bytes that the cache of packs may take
};

/// The positional "pack", --build and --cache-limit.
void add_shown_model(CLI::App& command, ShownModel& model);
/// The same of one file alone, so that other words may stand behind it.
void add_one_shown_model(CLI::App& command, ShownModel& model);
/// Once the command line was parsed: a usage error where packs stand beside other files, or --build is none,
/// or has nothing to build.
void check_shown_model(const CLI::App& command, const ShownModel& model);
/// The pack; of models the one in the cache (launch/model_cache.hpp), built first where it must be. Error
/// where an output would be written over a file of the models.
std::filesystem::path pack_of(const ShownModel& model, const std::vector<std::filesystem::path>& outputs);

}  // namespace triptych
