// The strategies for a pack, with what they need of it beside its hierarchy.
#pragma once

#include "scene/pack.hpp"
#include "visibility/strategies.hpp"

namespace triptych {

struct StrategyChoice {
  StrategyKind kind = StrategyKind::occlusion;
  StrategyOptions options = {};
};

/// What make_strategy() takes for this kind: finds the cells that `portals` needs, which reads the pack's
/// full detail. Where no wall divides the model, says so and chooses `occlusion` instead, whose pictures are
/// the same. Error as Pack::read_chunk().
StrategyChoice choose_strategy(const Pack& pack, StrategyKind kind, const StrategyOptions& options = {});

}  // namespace triptych
