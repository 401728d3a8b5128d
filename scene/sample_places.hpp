// Where the samples of a pixel lie.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>

namespace triptych {

/// How many samples a pixel may have: 1, 4, 8 or 16.
bool is_sample_count(uint64_t samples);

/// From a pixel's centre to one of its samples, in thirty-seconds of a pixel, x to the right and y up: −15 to
/// 15, so that none lies on the border of a picture, which snapping could move something onto.
struct SamplePlace {
  int8_t x = 0, y = 0;
  glm::dvec2 pixels() const { return glm::dvec2(x, y) / 32.0; }
};

/// The places of that many samples, always the same (docs/algorithms.md lists them); their mean is the
/// centre. Precondition: is_sample_count(samples).
std::span<const SamplePlace> sample_places(uint32_t samples);

}  // namespace triptych
