// Vertices from a chunk's lattice to the window, a vector of them at a time.
// Included once by the file of each instruction set.
#pragma once

#include "raster/simd/kernels.hpp"
#include "raster/simd/vector.hpp"

namespace triptych {
namespace {

[[gnu::always_inline]] inline Floats along(const float* row, const Floats& x, const Floats& y,
                                           const Floats& z) {
  return ((row[0] * x + row[1] * y) + row[2] * z) + row[3];
}

/// The operations, and their order, of GeometryTerms::to_clip and
/// WindowTransform.
template <bool orthographic>
[[gnu::always_inline]] inline void transform(const TransformTerms& terms, const LatticePoints& points,
                                             int32_t count, const WindowPoints& result) {
  for (int32_t i = 0; i < count; i += lanes) {
    const Floats x = to_float(load(points.x + i) + terms.cell[0]),
                 y = to_float(load(points.y + i) + terms.cell[1]),
                 z = to_float(load(points.z + i) + terms.cell[2]);
    const Floats eye_x = along(terms.rows[0], x, y, z), eye_y = along(terms.rows[1], x, y, z),
                 eye_z = along(terms.rows[2], x, y, z);
    const float* const frustum = terms.frustum;
    Floats clip_x, clip_y, clip_z, w;
    if (orthographic) {
      clip_x = frustum[0] * eye_x + frustum[2];
      clip_y = frustum[1] * eye_y + frustum[3];
      clip_z = terms.depth[0] * eye_z + terms.depth[1];
      w = splat(1.0f);
    } else {
      clip_x = frustum[0] * eye_x + frustum[2] * eye_z;
      clip_y = frustum[1] * eye_y + frustum[3] * eye_z;
      clip_z = splat(terms.depth[0]);
      w = -eye_z;
    }
    const Floats guard_x = terms.guard_x * w, guard_y = terms.guard_y * w;
    const Ints planes[5] = {w - clip_z >= 0, guard_x - clip_x >= 0, guard_x + clip_x >= 0,
                            guard_y - clip_y >= 0, guard_y + clip_y >= 0};
    const Ints inside = planes[0] & planes[1] & planes[2] & planes[3] & planes[4];
    const Floats over_w = 1.0f / w;
    store(select(inside, to_nearest((clip_x * over_w) * terms.scale_x) + terms.middle_x, splat(outside_x)),
          result.x + i);
    Ints row = to_nearest((clip_y * over_w) * terms.scale_y) + terms.middle_y;
    if (any(~inside)) {
      Ints beyond = {};
      for (int plane = 0; plane < 5; ++plane) beyond |= ~planes[plane] & 1 << plane;
      row = select(inside, row, beyond);
    }
    store(row, result.y + i);
    store(bits_of(clip_z * over_w), result.depth + i);
  }
}

void transform_vertices(const TransformTerms& terms, const LatticePoints& points, int32_t count,
                        const WindowPoints& result) {
  if (terms.orthographic) {
    transform<true>(terms, points, count, result);
  } else {
    transform<false>(terms, points, count, result);
  }
}

}  // namespace
}  // namespace triptych
