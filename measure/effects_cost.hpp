// What each effect that a model calls for costs, added one after the other.
#pragma once

#include "base/distribution.hpp"
#include "nodes/local_pipeline.hpp"
#include "scene/pack.hpp"

#include <optional>
#include <vector>

namespace triptych {

/// Of the frames of a path with some effects.
struct EffectsCost {
  std::optional<Effect> added;          ///< to the row before; nullopt: there are none
  std::vector<double> wall_ms, cpu_ms;  ///< of each frame, medians over rounds
  EffectUse use;                        ///< of the effect that was added: sums over the frames of one round
  uint64_t used_frames = 0;             ///< of those, how many it took part in
  double triangles = 0;                 ///< drawn, mean over frames
};

/// The effects that the pack names.
std::vector<Effect> called_for(const Skeleton& skeleton);

/// Plays the frames without any effect, and with one more of `effects` at a time, in turn, `rounds` times.
std::vector<EffectsCost> measure_effects(LocalPipeline& pipeline, const std::vector<FrameRequest>& frames,
                                         const std::vector<Effect>& effects, size_t rounds);

}  // namespace triptych
