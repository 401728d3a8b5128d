// Whether the files of a model of several lie where they seem to belong.
#pragma once

#include "preprocess/plan.hpp"

#include <string>
#include <vector>

namespace triptych {

/// A warning for each file that is so far from the nearest other one, or that much larger or smaller, that
/// its origin or its unit may be another. Names both files, their units, their sizes and the distance of
/// their boxes. None for a model of one file.
std::vector<std::string> federation_warnings(const Model& model, const BuildPlan& plan);

}  // namespace triptych
