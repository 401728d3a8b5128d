#include "nodes/pack_strategy.hpp"

#include "base/notice.hpp"
#include "cells/make_cells.hpp"

namespace triptych {

StrategyChoice choose_strategy(const Pack& pack, StrategyKind kind, const StrategyOptions& options) {
  StrategyChoice choice{kind, options};
  if (kind != StrategyKind::portals) return choice;
  if (!choice.options.cells) choice.options.cells = std::make_shared<const CellGraph>(make_cells(pack));
  if (choice.options.cells->cells.size() > 1) return choice;
  notice("{}: no walls lie across an axis and divide it, so there are no portals; culls by occlusion",
         pack.name());
  choice.kind = StrategyKind::occlusion;
  return choice;
}

}  // namespace triptych
