// Towers whose storeys repeat: a small building, and which of its storeys stands where.
#pragma once

#include "samples/building/floor_plan.hpp"
#include "samples/building/furnisher.hpp"

#include <span>
#include <vector>

namespace triptych {

/// For each storey of a tower the storey of a smaller building that it is: the lowest and the highest are its
/// lowest and highest, those between repeat after `different` ones. `floors` and `different` are at least 1.
std::vector<int> repeated_storeys(int floors, int different);

/// How many storeys the smaller building has.
int different_storeys(std::span<const int> storeys);

/// The whole tower, of the smaller building's plan and furniture; rooms keep their names.
FloorPlan repeat_plan(const FloorPlan& plan, std::span<const int> storeys);
std::vector<FurniturePlacement> repeat_placements(const FloorPlan& plan,
                                                  const std::vector<FurniturePlacement>& placements,
                                                  std::span<const int> storeys);

}  // namespace triptych
