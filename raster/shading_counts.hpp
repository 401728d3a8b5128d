// What shading had to do beyond one colour a triangle; threads add to it side by side.
#pragma once

#include "base/clock.hpp"

#include <array>
#include <atomic>
#include <cstdint>

namespace triptych {

struct ShadingCounts {
  /// Pixels whose colours vary, by ShadeKind; and of those the ones that have normals of the model's files.
  std::array<std::atomic<uint64_t>, 6> varying_pixels = {}, smooth_pixels = {};
  std::array<std::atomic<double>, 6> varying_ms = {};  ///< of all threads together, as blending_ms
  /// Those that have colours of vertices, below a texture, too, or light of their own.
  std::atomic<uint64_t> colored_pixels = 0, emissive_pixels = 0;
  std::atomic<uint64_t> baked_pixels = 0, occluded_pixels = 0;  ///< the same of baked light
  std::atomic<uint64_t> smooth_triangles = 0;                   ///< with such normals, again in each band
  std::atomic<uint64_t> blended_fragments = 0;                  ///< of transparent triangles
  std::atomic<uint64_t> splits = 0;                             ///< EffectUse::splits
  std::atomic<double> blending_ms = 0;
  std::atomic<uint64_t> sky_pixels = 0;  ///< or samples of them, that show the sky
  std::atomic<double> sky_ms = 0;
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
