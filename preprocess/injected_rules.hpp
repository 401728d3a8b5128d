// The faults of `--inject` that are faults of a build.
#pragma once

#include "preprocess/build_rules.hpp"

namespace triptych {

/// The rules of a build in this process: the faults of `--inject` take some away.
BuildRules injected_build_rules();

}  // namespace triptych
