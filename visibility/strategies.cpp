#include "visibility/strategies.hpp"

#include "base/error.hpp"
#include "visibility/occlusion_strategy.hpp"
#include "visibility/portal_strategy.hpp"
#include "visibility/whole_cut_strategy.hpp"

namespace triptych {

const std::vector<std::pair<std::string, StrategyKind>>& strategy_names() {
  static const std::vector<std::pair<std::string, StrategyKind>> names = {
      {"none", StrategyKind::none},
      {"frustum", StrategyKind::frustum},
      {"occlusion", StrategyKind::occlusion},
      {"approximate", StrategyKind::approximate},
      {"portals", StrategyKind::portals}};
  return names;
}

const std::string& strategy_name(StrategyKind kind) {
  return strategy_names()[static_cast<size_t>(kind)].first;
}

bool counts_pixels(StrategyKind kind) { return kind == StrategyKind::approximate; }

std::unique_ptr<Strategy> make_strategy(StrategyKind kind, const Hierarchy& hierarchy,
                                        const StrategyOptions& options) {
  if (kind == StrategyKind::approximate)
    return std::make_unique<ApproximateOcclusionStrategy>(hierarchy, options.batches, options.min_pixels);
  return make_exact_strategy(kind, hierarchy, options);
}

std::unique_ptr<ExactStrategy> make_exact_strategy(StrategyKind kind, const Hierarchy& hierarchy,
                                                   const StrategyOptions& options) {
  switch (kind) {
    case StrategyKind::none:
      return std::make_unique<WholeCutStrategy>(FrustumCulling::off);
    case StrategyKind::frustum:
      return std::make_unique<WholeCutStrategy>(FrustumCulling::on);
    case StrategyKind::occlusion:
      return std::make_unique<OcclusionStrategy>(hierarchy, options.batches);
    case StrategyKind::portals:
      if (!options.cells) fail("strategy", "\"portals\" needs the cells of the pack");
      return std::make_unique<PortalStrategy>(options.cells);
    case StrategyKind::approximate:
      break;
  }
  fail("strategy", "\"approximate\" may leave out what is visible; an exact strategy is needed here");
}

}  // namespace triptych
