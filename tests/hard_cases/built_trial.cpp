#include "preprocess/injected_rules.hpp"
#include "tests/hard_cases/trials.hpp"

#include <fmt/core.h>
#include <unistd.h>

namespace triptych::hard_cases {

BuiltTrial::BuiltTrial(const Trial& trial) {
  static int count = 0;
  file_ =
      std::filesystem::temp_directory_path() / fmt::format("triptych_hard_{}_{}.tpk", ::getpid(), count++);
  BuildOptions options = trial.build;
  options.rules = injected_build_rules();
  report_ = build_pack(trial.model, options, file_);
  pack_ = std::make_unique<Pack>(file_);
}

BuiltTrial::~BuiltTrial() {
  std::error_code ignored;  // the next run has another name
  std::filesystem::remove(file_, ignored);
}

}  // namespace triptych::hard_cases
