#include "launch/shown_model.hpp"

#include "launch/build_flags.hpp"
#include "launch/model_cache.hpp"
#include "launch/number_flags.hpp"
#include "model/import/import.hpp"

#include <algorithm>
#include <fmt/core.h>

namespace triptych {

namespace {

void add_build_of_model(CLI::App& command, ShownModel& model) {
  command
      .add_option("--build", model.build,
                  "Of model files: flags of `build`, as one word: --build \"--keep none\"")
      ->type_name("FLAGS");
  add_cache_limit(command, model.cache_limit,
                  "Of model files: how much their packs may take in the cache; those that were wanted the "
                  "longest time ago go first (default: a tenth of its disk)");
}

}  // namespace

void add_shown_model(CLI::App& command, ShownModel& model) {
  command
      .add_option("pack", model.files,
                  "The pack; or model files, which become one model: a pack of it is built and kept in "
                  "TRIPTYCH_CACHE (default: ~/.cache/triptych)")
      ->required()
      ->type_name("FILE");
  add_build_of_model(command, model);
}

void add_one_shown_model(CLI::App& command, ShownModel& model) {
  model.files.resize(1);
  command
      .add_option("pack", model.files.front(), "The pack; or a model file, of which a pack is built and kept")
      ->required()
      ->type_name("FILE");
  add_build_of_model(command, model);
}

void check_shown_model(const CLI::App& command, const ShownModel& model) {
  const auto other = std::find_if_not(model.files.begin(), model.files.end(), is_model_name);
  if (model.files.size() > 1 && other != model.files.end())
    throw CLI::ValidationError(
        "pack", fmt::format("{} is no model file, and stands by itself: only model files become one model",
                            other->string()));
  if (command.count("--build") == 0) return;
  if (other != model.files.end())
    throw CLI::ValidationError("--build", fmt::format("is of model files, and {} is none", other->string()));
  parse_build_flags(model.build, model.files);
}

std::filesystem::path pack_of(const ShownModel& model, const std::vector<std::filesystem::path>& outputs) {
  if (!is_model_name(model.files.front())) return model.files.front();
  check_is_no_model_file(outputs, model.files);
  return cached_pack(parse_build_flags(model.build, model.files), model.cache_limit);
}

}  // namespace triptych
