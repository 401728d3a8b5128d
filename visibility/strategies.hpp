// The available strategies, by the names that --cull takes.
#pragma once

#include "lod/hierarchy.hpp"
#include "visibility/hardware_cull.hpp"
#include "visibility/strategy.hpp"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace triptych {

enum class StrategyKind { none, frustum, occlusion };

/// Every kind with its name.
const std::vector<std::pair<std::string, StrategyKind>>& strategy_names();

/// options: for strategies that test boxes.
std::unique_ptr<ExactStrategy> make_exact_strategy(StrategyKind kind, const Hierarchy& hierarchy,
                                                   const CullOptions& options = {});

}  // namespace triptych
