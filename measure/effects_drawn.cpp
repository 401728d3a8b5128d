#include "measure/effects_drawn.hpp"

#include "measure/json.hpp"

namespace triptych {

nlohmann::json effects_drawn(const std::vector<FrameRecord>& frames) {
  nlohmann::json drawn = nlohmann::json::object();
  for (const Effect effect : all_effects) {
    std::vector<EffectUse> uses;
    for (const FrameRecord& frame : frames) {
      for (const EffectUse& use : frame.effects) {
        if (use.effect == effect) uses.push_back(use);
      }
    }
    if (uses.empty()) continue;
    drawn[std::string(effect_name(effect))] = {
        {"frames", uses.size()},
        {"ms", distribution_json(uses, [](const EffectUse& use) { return use.ms; })},
        {"draws", distribution_json(uses, [](const EffectUse& use) { return use.draws; })},
        {"fragments", distribution_json(uses, [](const EffectUse& use) { return use.fragments; })},
        {"simulation_steps",
         distribution_json(uses, [](const EffectUse& use) { return use.simulation_steps; })}};
  }
  return drawn;
}

}  // namespace triptych
