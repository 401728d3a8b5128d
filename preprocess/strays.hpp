// Objects that lie far from all others: often a slip of whoever modelled them.
#pragma once

#include "preprocess/object_extent.hpp"
#include "preprocess/plan.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace triptych {

/// The body of a model: the box of those objects whose centres lie, on each axis, between the first and the
/// last hundredth of all triangles. Empty if there are none.
Box body_of(std::span<const ObjectExtent> objects);

/// How far two boxes are apart; 0 where they touch.
double distance_of(const Box& a, const Box& b);

/// Indices of objects that are further from the body than a hundred times its diagonal, the farthest first.
/// None where the body has no size.
std::vector<uint32_t> strays(std::span<const ObjectExtent> objects);

/// A warning that names the farthest stray of a planned model, if there is one. Groups that repeat count as
/// one object.
std::optional<std::string> stray_warning(const Model& model, const BuildPlan& plan);

}  // namespace triptych
