// What shading had to do beyond one colour a triangle; threads add to it side by side.
#pragma once

#include "base/clock.hpp"

#include <atomic>
#include <cstdint>

namespace triptych {

struct ShadingCounts {
  std::atomic<uint64_t> varying_pixels = 0;             ///< whose colours vary over their triangle
  std::atomic<uint64_t> colored_pixels = 0;             ///< of those: with the colours of corners
  std::atomic<uint64_t> smooth_pixels = 0;              ///< of those: with normals of the model's files
  std::atomic<uint64_t> smooth_triangles = 0;           ///< with such normals, again in each band
  std::atomic<uint64_t> blended_fragments = 0;          ///< of transparent triangles
  std::atomic<uint64_t> splits = 0;                     ///< EffectUse::splits
  std::atomic<double> varying_ms = 0, blending_ms = 0;  ///< of all threads together
};

/// Adds to one of them how long it lived.
class TimedShading {
 public:
  explicit TimedShading(std::atomic<double>& ms) : ms_(ms) {}
  TimedShading(const TimedShading&) = delete;
  TimedShading& operator=(const TimedShading&) = delete;
  ~TimedShading() { ms_ += stopwatch_.milliseconds(); }

 private:
  std::atomic<double>& ms_;
  Stopwatch stopwatch_;
};

}  // namespace triptych
