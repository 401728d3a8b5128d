// The available strategies, by the names that --cull takes.
#pragma once

#include "cells/cell_graph.hpp"
#include "lod/hierarchy.hpp"
#include "visibility/hardware_cull.hpp"
#include "visibility/strategy.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace triptych {

enum class StrategyKind { none, frustum, occlusion, approximate, portals };

/// Every kind with its name, in the order of their numbers.
const std::vector<std::pair<std::string, StrategyKind>>& strategy_names();

const std::string& strategy_name(StrategyKind kind);

/// Whether StrategyOptions::min_pixels matters to it.
bool counts_pixels(StrategyKind kind);

struct StrategyOptions {
  /// For strategies that test boxes.
  CullOptions batches = {};
  /// For `approximate`: what covers fewer pixels may be left out. At least 1.
  uint32_t min_pixels = 4;
  /// For `portals`: of the pack that is drawn (cells/make_cells.hpp).
  std::shared_ptr<const CellGraph> cells = {};
};

/// Of any kind. Strategy::name() is the one that it was listed under; ApproximateStrategy and ExactStrategy
/// tell what it promises.
std::unique_ptr<Strategy> make_strategy(StrategyKind kind, const Hierarchy& hierarchy,
                                        const StrategyOptions& options = {});

/// For code that claims exactness. Error (place: strategy) for a kind that is not exact, and for one that
/// needs what the options do not have.
std::unique_ptr<ExactStrategy> make_exact_strategy(StrategyKind kind, const Hierarchy& hierarchy,
                                                   const StrategyOptions& options = {});

}  // namespace triptych
