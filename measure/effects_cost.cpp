#include "measure/effects_cost.hpp"

#include "base/progress.hpp"
#include "base/spent_time.hpp"

#include <algorithm>

namespace triptych {

namespace {

void add(EffectUse& sum, const EffectUse& use) {
  sum.effect = use.effect;
  sum.ms += use.ms;
  sum.draws += use.draws;
  sum.binds += use.binds;
  sum.upload_bytes += use.upload_bytes;
  sum.fragments += use.fragments;
  sum.simulation_steps += use.simulation_steps;
  sum.variants = std::max(sum.variants, use.variants);
  sum.splits += use.splits;
}

struct FrameTimes {
  std::vector<double> wall_ms, cpu_ms;  ///< one a round
};

}  // namespace

std::vector<Effect> called_for(const Skeleton& skeleton) {
  std::vector<Effect> effects;
  for (const Effect effect : all_effects) {
    if (std::ranges::count(skeleton.effects, effect_name_in_pack(effect)) > 0) effects.push_back(effect);
  }
  return effects;
}

std::vector<EffectsCost> measure_effects(LocalPipeline& pipeline, const std::vector<FrameRequest>& frames,
                                         const std::vector<Effect>& effects, size_t rounds) {
  std::vector<EffectsCost> costs(effects.size() + 1);
  for (size_t i = 0; i < effects.size(); ++i) costs[i + 1].added = effects[i];
  std::vector<std::vector<FrameTimes>> times(costs.size(), std::vector<FrameTimes>(frames.size()));
  Progress progress("rounds", rounds * costs.size());
  for (size_t round = 0; round < rounds; ++round) {
    Effects shown = Effects::none();
    for (size_t i = 0; i < costs.size(); ++i) {
      EffectsCost& cost = costs[i];
      if (cost.added) shown.add(*cost.added);
      cost.use = {};
      cost.used_frames = 0;
      cost.triangles = 0;
      pipeline.forget();
      for (size_t k = 0; k < frames.size(); ++k) {
        FrameRequest frame = frames[k];
        frame.state.effects = shown;
        const StageWatch watch;
        const FrameRecord& record = pipeline.draw(frame);
        const SpentTime spent = watch.spent();
        times[i][k].wall_ms.push_back(spent.wall_ms);
        times[i][k].cpu_ms.push_back(spent.cpu_ms);
        cost.triangles += static_cast<double>(record.drawn_triangles) / static_cast<double>(frames.size());
        for (const EffectUse& use : record.effects) {
          if (use.effect != cost.added) continue;
          add(cost.use, use);
          ++cost.used_frames;
        }
      }
      progress.advance();
    }
  }
  for (size_t i = 0; i < costs.size(); ++i) {
    for (const FrameTimes& of_frame : times[i]) {
      costs[i].wall_ms.push_back(distribution(of_frame.wall_ms).p50);
      costs[i].cpu_ms.push_back(distribution(of_frame.cpu_ms).p50);
    }
  }
  return costs;
}

}  // namespace triptych
