// Two revisions of a model as one, whose colours say what changed.
#pragma once

#include "measure/difference/pack_difference.hpp"
#include "model/model.hpp"

namespace triptych {

/// The newer revision at full detail: what was added green, what differs from the older one yellow, the rest
/// grey; and what was removed, from the older one, red. Objects keep what is told of them, and have a further
/// set of properties "Revision", which says what became of them. Meshes that are placed several times stay
/// shared; all of them are held in memory.
Model difference_model(const Revision& before, const Revision& after, const PackDifference& difference);

}  // namespace triptych
