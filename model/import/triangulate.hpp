// Triangulates faces of many corners.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>
#include <vector>

namespace triptych {

/// Faces of more corners are cut as fans: ear clipping takes time with the square of the number of corners.
inline constexpr size_t max_clipped_corners = 4096;
inline constexpr std::string_view fan_warning =
    "faces of more than 4,096 corners were cut as fans, which only suits convex ones";

/// Replaces `triangles` by corners.size() − 2 triangles over the corners' numbers, winding kept; none for
/// fewer than three corners. A convex face becomes the fan of its first corner. Others are cut by ear
/// clipping (G. H. Meisters, "Polygons have ears", 1975) on the plane of Newell's normal, which is the best
/// plane of a face that is not planar. Where no ear is left (the outline crosses itself) or coordinates are
/// not finite, the rest is a fan.
void triangulate(std::span<const glm::dvec3> corners, std::vector<std::array<uint32_t, 3>>& triangles);

}  // namespace triptych
