#include "visibility/strategies.hpp"

#include "visibility/occlusion_strategy.hpp"
#include "visibility/whole_cut_strategy.hpp"

namespace triptych {

const std::vector<std::pair<std::string, StrategyKind>>& strategy_names() {
  static const std::vector<std::pair<std::string, StrategyKind>> names = {
      {"none", StrategyKind::none},
      {"frustum", StrategyKind::frustum},
      {"occlusion", StrategyKind::occlusion}};
  return names;
}

std::unique_ptr<ExactStrategy> make_exact_strategy(StrategyKind kind, const Hierarchy& hierarchy,
                                                   const CullOptions& options) {
  switch (kind) {
    case StrategyKind::none:
      return std::make_unique<WholeCutStrategy>(FrustumCulling::off);
    case StrategyKind::frustum:
      return std::make_unique<WholeCutStrategy>(FrustumCulling::on);
    case StrategyKind::occlusion:
      break;
  }
  return std::make_unique<OcclusionStrategy>(hierarchy, options);
}

}  // namespace triptych
