// The nearest neighbours of many points.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace triptych {

/// For each point the indices of its `count` nearest other points (fewer where there are not so many),
/// nearest first. Of equally near points any may be chosen, but always the same; of points in one place,
/// which can be all, different points get different ones, so that the graph of neighbours is connected. A
/// balanced tree of medians (Bentley 1975); run on all cores.
std::vector<std::vector<uint32_t>> nearest_neighbours(std::span<const glm::dvec3> points, uint32_t count);

}  // namespace triptych
