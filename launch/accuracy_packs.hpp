// The packs of `measure accuracy`: those of the command line, and those that it builds for itself.
#pragma once

#include "launch/build_flags.hpp"
#include "measure/accuracy/accuracy.hpp"
#include "nodes/pack_device.hpp"
#include "session/run_options.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace triptych {

/// What the command line says of them, beside the first one.
struct AccuracyPacks {
  std::vector<std::filesystem::path> others;
  std::vector<std::filesystem::path> models;
  std::vector<std::string>
      builds;  ///< flags of `build`, in one text, for each pack that is built of the models
};

/// --with, --model and --build; the first pack need not be there.
void add_pack_flags(CLI::App& command, AccuracyPacks& packs);
/// Checks that once the command line was parsed.
void check_packs(const AccuracyPacks& packs, const std::filesystem::path& first);

struct NamedPack {
  std::filesystem::path file;
  std::string label;
  std::optional<double> build_seconds{};
};

/// The packs of the command line, then those of --build, which are built into the folder. Error as of builds.
std::vector<NamedPack> named_packs(const AccuracyPacks& packs, const std::filesystem::path& first,
                                   const std::filesystem::path& folder);

/// Opened, what draws them, and what the run hides of each. Error for packs that are not of one model.
class AccuracySubjects {
 public:
  AccuracySubjects(const std::vector<NamedPack>& named, const std::vector<ChosenDevice>& chosen,
                   const RunOptions& run);
  const std::vector<AccuracySubject>& list() const { return subjects_; }
  const Skeleton& skeleton() const { return packs_.front()->skeleton(); }

 private:
  std::vector<std::unique_ptr<Pack>> packs_;
  std::vector<std::unique_ptr<PackDevice>> devices_;
  std::vector<AccuracySubject> subjects_;
};

}  // namespace triptych
