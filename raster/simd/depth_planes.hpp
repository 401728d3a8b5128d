// Depths over triangles, a vector of triangles at a time: depth_plane() in
// raster/triangle.cpp. Included once by the file of each instruction set.
#pragma once

#include "raster/simd/kernels.hpp"
#include "raster/simd/vector.hpp"

namespace triptych {
namespace {

/// The same corner of each triangle.
struct Corners {
  Ints x, y;
  Floats depth;
};

[[gnu::always_inline]] inline Corners corners_at(const WindowPoints& points, Ints vertices) {
  return {gather(points.x, vertices), gather(points.y, vertices),
          (Floats)gather(reinterpret_cast<const int32_t*>(points.depth), vertices)};
}

/// The same corner's vertices.
[[gnu::always_inline]] inline Ints vertices_of(const uint32_t* corner_of_triangles, Ints triangles) {
  return gather(reinterpret_cast<const int32_t*>(corner_of_triangles), triangles);
}

[[gnu::always_inline]] inline Ints layers_of(const SetUpTerms& terms, Ints triangles) {
  Ints layer = {};
  if (terms.layers == nullptr) return layer;
  for (int32_t i = 0; i < lanes; ++i) layer[i] = terms.layers[triangles[i]];
  return layer;
}

/// Some of the triangles' numbers to the end of a list.
[[gnu::always_inline]] inline void append(Ints triangles, Ints some, uint32_t* list, int32_t& count) {
  for (uint32_t rest = bits(some); rest != 0; rest &= rest - 1)
    list[count++] = static_cast<uint32_t>(triangles[__builtin_ctz(rest)]);
}

/// Twice the areas, positive where corners go round counter-clockwise. Sides
/// are below 2²⁴: doubles hold products and their differences exactly.
struct Areas {
  Doubles exact[2];  ///< of the lower half of the lanes, and of the upper
  Floats rounded;
  [[gnu::always_inline]] Areas(const Corners& a, const Corners& b, const Corners& c) {
    for (int upper = 0; upper < 2; ++upper) {
      exact[upper] =
          half(b.x - a.x, upper) * half(c.y - a.y, upper) - half(c.x - a.x, upper) * half(b.y - a.y, upper);
    }
    rounded = to_float(exact[0], exact[1]);
  }
};

struct DepthPlanes {
  Floats slope_x, slope_y, error;
};

/// Where floats may be off by more, of the depth, depths are computed in
/// doubles.
constexpr float max_float_error = 0x1p-15f;

[[gnu::always_inline]] inline DepthPlanes depth_planes(const Corners& a, const Corners& b, const Corners& c,
                                                       Floats area, Floats high) {
  constexpr float unit_roundoff = 0x1p-24f;
  const Floats dx1 = to_float(b.x - a.x), dx2 = to_float(c.x - a.x), dy1 = to_float(b.y - a.y),
               dy2 = to_float(c.y - a.y), dz1 = b.depth - a.depth, dz2 = c.depth - a.depth;
  const Floats z1y2 = dz1 * dy2, z2y1 = dz2 * dy1, z2x1 = dz2 * dx1, z1x2 = dz1 * dx2;
  const Floats terms_x = (magnitude(z1y2) + magnitude(z2y1)) / magnitude(area),
               terms_y = (magnitude(z2x1) + magnitude(z1x2)) / magnitude(area);
  const Floats reach_x = greater(magnitude(dx1), magnitude(dx2)),
               reach_y = greater(magnitude(dy1), magnitude(dy2));
  return {(z1y2 - z2y1) / area, (z2x1 - z1x2) / area,
          2 * unit_roundoff * (8 * (terms_x * reach_x + terms_y * reach_y) + 2 * high)};
}

struct PreciseSlopes {
  double x[lanes], y[lanes];
};

/// The same in doubles; of those that are `wanted`, the error becomes that of
/// these.
[[gnu::always_inline]] inline PreciseSlopes precise_planes(const Corners& a, const Corners& b,
                                                           const Corners& c, const Areas& area, Ints wanted,
                                                           Floats high, Floats& error) {
  constexpr double unit_roundoff = 0x1p-53;
  PreciseSlopes slopes;
  Doubles errors[2];
  for (int upper = 0; upper < 2; ++upper) {
    const Doubles dx1 = half(b.x - a.x, upper), dx2 = half(c.x - a.x, upper), dy1 = half(b.y - a.y, upper),
                  dy2 = half(c.y - a.y, upper), first = half(a.depth, upper),
                  dz1 = half(b.depth, upper) - first, dz2 = half(c.depth, upper) - first, z1y2 = dz1 * dy2,
                  z2y1 = dz2 * dy1, z2x1 = dz2 * dx1, z1x2 = dz1 * dx2, size = magnitude(area.exact[upper]);
    const Doubles terms_x = (magnitude(z1y2) + magnitude(z2y1)) / size,
                  terms_y = (magnitude(z2x1) + magnitude(z1x2)) / size;
    const Doubles reach_x = magnitude(dx1) < magnitude(dx2) ? magnitude(dx2) : magnitude(dx1),
                  reach_y = magnitude(dy1) < magnitude(dy2) ? magnitude(dy2) : magnitude(dy1);
    errors[upper] = 2 * unit_roundoff * (8 * (terms_x * reach_x + terms_y * reach_y) + 2 * half(high, upper));
    const Doubles slope_x = (z1y2 - z2y1) / area.exact[upper], slope_y = (z2x1 - z1x2) / area.exact[upper];
    __builtin_memcpy(slopes.x + upper * (lanes / 2), &slope_x, sizeof slope_x);
    __builtin_memcpy(slopes.y + upper * (lanes / 2), &slope_y, sizeof slope_y);
  }
  error = select(wanted, to_float(errors[0], errors[1]) + 2 * 0x1p-24f * high, error);
  return slopes;
}

}  // namespace
}  // namespace triptych
