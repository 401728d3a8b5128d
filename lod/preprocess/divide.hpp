// The first partition: a mesh's surface into parts, and which of their points they share.
#pragma once

#include "lod/preprocess/part.hpp"
#include "scene/partition.hpp"

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace triptych {

/// Splits the surface until every part is within the limits. `shared`, sorted by before(): points that
/// surfaces beyond this one may have too; they are border points, as those are that several parts have.
std::vector<Part> divide(Surface surface, const PartitionLimits& limits, std::span<const glm::ivec3> shared);

}  // namespace triptych
