// Random scenes and cameras, for as long as one likes: what fails is a seed, which makes the same trial
// again.
#pragma once

#include "tests/hard_cases/hard_case.hpp"

#include <cstdint>

namespace triptych::hard_cases {

/// A scene of several random kinds of objects at a random scale and place, and cameras that do not behave.
Trial random_trial(uint32_t seed);

/// Tries one seed after the other through build, cuts and pictures, and prints those that fail. Returns how
/// many did. A context must be current.
int run_stress(double minutes, uint32_t first_seed);

}  // namespace triptych::hard_cases
