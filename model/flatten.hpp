// Models without groups.
#pragma once

#include "model/model.hpp"

namespace triptych {

/// The same model as one list of instances: those that belong to no group, then those of each placement of a
/// group, its own before those of the groups in it. Transforms are composed in double.
Model flattened(Model model);

}  // namespace triptych
