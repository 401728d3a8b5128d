// Many frame states, one after the other: what is hidden and cut away changes from each to the next.
#pragma once

#include <cstddef>
#include <cstdint>

namespace triptych::hard_cases {

/// Draws so many states of random scenes (random_trial(), a hundred of each): a camera, a section of up to
/// six planes and a box, and a set of hidden objects, each at random, in one pipeline, so that V(i−1) is of
/// another state. The culled picture must be the un-culled one, and what owns a pixel there must be in the
/// visible set. Prints what fails by seed and state; returns how many do. A context must be current.
size_t run_states(size_t count, uint32_t first_seed);

}  // namespace triptych::hard_cases
