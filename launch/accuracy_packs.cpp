#include "launch/accuracy_packs.hpp"

#include "base/error.hpp"
#include "launch/choice_flag.hpp"
#include "launch/number_flags.hpp"
#include "launch/pack_labels.hpp"
#include "launch/run_program.hpp"

#include <algorithm>
#include <fmt/core.h>

namespace triptych {

void add_pack_flags(CLI::App& command, AccuracyPacks& packs) {
  take_list(command.add_option("--with", packs.others, "Further packs of the same model, built otherwise"))
      ->type_name("FILE.tpk,...");
  take_list(command.add_option("--model", packs.models, "Model files that --build builds packs of"))
      ->type_name("FILE,...");
  command
      .add_option(
          "--build", packs.builds,
          "A further pack, of --model, built with these flags of `build`: --build \"--keep none\"; once "
          "for each pack")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_name("FLAGS");
  command.get_option("pack")->required(false);
}

void check_packs(const AccuracyPacks& packs, const std::filesystem::path& first) {
  if (first.empty() && packs.builds.empty()) throw CLI::RequiredError("pack, or --model and --build");
  if (first.empty() && !packs.others.empty()) throw CLI::ValidationError("--with", "stands beside a pack");
  if (packs.models.empty() != packs.builds.empty())
    throw CLI::ValidationError(packs.models.empty() ? "--build needs --model" : "--model needs --build");
  for (const std::string& words : packs.builds) {
    parse_build_flags(words, packs.models);
    if (std::count(packs.builds.begin(), packs.builds.end(), words) > 1)
      throw CLI::ValidationError("--build", fmt::format("\"{}\" is given twice", words));
  }
}

std::vector<NamedPack> named_packs(const AccuracyPacks& packs, const std::filesystem::path& first,
                                   const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  if (!first.empty()) files.push_back(first);
  files.insert(files.end(), packs.others.begin(), packs.others.end());
  const std::vector<std::string> labels = pack_labels(files);
  std::vector<NamedPack> named;
  for (size_t i = 0; i < files.size(); ++i) named.push_back({files[i], labels[i]});
  for (const std::string& words : packs.builds) {
    const std::filesystem::path file = folder / fmt::format("build-{}.tpk", named.size());
    const nlohmann::json built = run_build(parse_build_flags(words, packs.models), file);
    named.push_back(
        {file, "build " + (words.empty() ? "by default" : words), built["seconds"].get<double>()});
  }
  return named;
}

AccuracySubjects::AccuracySubjects(const std::vector<NamedPack>& named,
                                   const std::vector<ChosenDevice>& chosen, const RunOptions& run) {
  for (const auto& [file, label, build_seconds] : named) {
    packs_.push_back(std::make_unique<Pack>(file));
    const uint64_t here = packs_.back()->skeleton().source_triangles,
                   first = packs_.front()->skeleton().source_triangles;
    if (here != first)
      fail(file.string(), "is a pack of another model: {} source triangles, and {} has {}", here,
           named.front().label, first);
  }
  for (const auto& pack : packs_) {
    std::vector<SpeedDevice> devices;
    for (const ChosenDevice& device : chosen) {
      devices_.push_back(std::make_unique<PackDevice>(*pack, device.options));
      devices.push_back(
          {device_name(device.options.kind), devices_.back()->hierarchy(), devices_.back()->device()});
    }
    const NamedPack& name = named[subjects_.size()];
    subjects_.push_back({name.label, devices_.back()->representation().name(), *pack, devices,
                         name.build_seconds, load_hiding(run, *pack)});
  }
}

}  // namespace triptych
