// Which source object of one revision of a model is which of the next.
#pragma once

#include "measure/difference/object_shapes.hpp"

#include <vector>

namespace triptych {

/// no_id: the other revision alone has it.
struct ObjectPair {
  SourceObjectId before = no_id, after = no_id;
};

/// Every object of both, by ascending `after`, those without one last. Objects are the same if their GUID is;
/// of those without, or whose GUID others of their revision have as well, if their own name and those of what
/// they are in are. Of several of one name those are the same that are built alike, then those at one place,
/// then the first and the first, and so on.
std::vector<ObjectPair> pair_objects(const SourceObjects& before, const ObjectShapes& before_shapes,
                                     const SourceObjects& after, const ObjectShapes& after_shapes);

}  // namespace triptych
