// How noisy baked light is, by its number of samples.
#pragma once

#include "light/bake.hpp"

#include <cstdint>
#include <vector>

namespace triptych {

/// Light gathered with so many samples, against the reference.
struct LightNoise {
  uint32_t samples = 0;
  double seconds = 0;        ///< of gathering
  double rmse = 0;           ///< of irradiance, by area, in units of that under which white shows as white
  double openness_rmse = 0;  ///< of ambient occlusion, by area
};

struct LightNoiseReport {
  LightReport light;
  double refinement_seconds = 0;
  uint32_t reference_samples = 0;
  double reference_seconds = 0;
  std::vector<LightNoise> rows;
};

/// The reference has 64 times the most of the samples, in other directions. Textures count as white. Error
/// (the model) where nothing is to be gathered.
LightNoiseReport measure_light_noise(const Model& model, const LightOptions& options,
                                     const std::vector<uint32_t>& samples);

}  // namespace triptych
