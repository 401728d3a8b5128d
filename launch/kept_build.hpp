// A whole build in a cache: where nothing changed since, its pack is only copied.
#pragma once

#include "base/build_cache.hpp"
#include "launch/model_content.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

namespace triptych {

class KeptBuild {
 public:
  /// Reads the models' files. The cache must outlive it.
  KeptBuild(BuildCache& cache, const BuildFlags& flags);

  /// If the cache has the pack of the same files and flags: puts it in place, and returns what keep() was
  /// given. Error if it cannot be written, or while another process builds that pack.
  std::optional<nlohmann::json> take(const std::filesystem::path& pack) const;

  /// Adds a pack that was built since, and its report, which names the files that were read ("files").
  /// Nothing where one of them changed meanwhile.
  void keep(nlohmann::json report, const std::filesystem::path& pack) const;

 private:
  BuildCache& cache_;
  ModelContent content_;
  ContentKey report_key_, pack_key_;
};

}  // namespace triptych
