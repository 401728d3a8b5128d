// Where the colours of corners meet with a seam.
#pragma once

#include "simplify/surface.hpp"

#include <cstdint>
#include <vector>

namespace triptych {

/// Colours that differ by this much in a channel, of 255, are told apart at a glance: less is noise, or part
/// of a gradient.
inline constexpr int distinct_colors = 32;
/// Colours that differ by no more look the same.
inline constexpr int equal_colors = 6;

/// The largest difference of a channel.
int color_difference(const VertexColor& a, const VertexColor& b);
/// The same of baked light, in steps that are about as distinct: a byte of irradiance counts as two.
int light_difference(const VertexLight& a, const VertexLight& b);
/// The larger of both.
int color_difference(const SurfaceCorner& a, const SurfaceCorner& b);

/// Triangles of one material that are connected by edges at whose ends their colours are not distinct.
struct ColorCharts {
  std::vector<uint32_t> of_triangles;  ///< for each triangle its chart
  std::vector<uint32_t> materials;     ///< for each chart its material
};

/// Precondition: the surface has colours.
ColorCharts color_charts(const Surface& surface);

}  // namespace triptych
