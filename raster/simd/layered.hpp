// Triangles of a layer, whose depths are those of their planes as they are:
// ExactPlane and put_below(), a vector of triangles at a time. Included once by
// the file of each instruction set.
#pragma once

#include "raster/simd/kernels.hpp"
#include "raster/simd/piece_limits.hpp"
#include "raster/simd/prepared.hpp"
#include "raster/simd/vector.hpp"

namespace triptych {
namespace {

/// Corners in clip space, half a vector of them.
struct ExactCorners {
  Doubles x, y, z, w;

  /// The operations, and their order, of VertexStage::to_clip.
  [[gnu::always_inline]] ExactCorners(const TransformTerms& terms, Doubles lattice_x, Doubles lattice_y,
                                      Doubles lattice_z) {
    const auto along = [&](const float* row) __attribute__((always_inline)) {
      return ((double{row[0]} * lattice_x + double{row[1]} * lattice_y) + double{row[2]} * lattice_z) +
             double{row[3]};
    };
    const Doubles eye_x = along(terms.rows[0]), eye_y = along(terms.rows[1]), eye_z = along(terms.rows[2]);
    const double frustum[4] = {terms.frustum[0], terms.frustum[1], terms.frustum[2], terms.frustum[3]};
    if (terms.orthographic) {
      x = frustum[0] * eye_x + frustum[2];
      y = frustum[1] * eye_y + frustum[3];
      z = double{terms.depth[0]} * eye_z + double{terms.depth[1]};
      w = splat_double(1);
    } else {
      x = frustum[0] * eye_x + frustum[2] * eye_z;
      y = frustum[1] * eye_y + frustum[3] * eye_z;
      z = splat_double(terms.depth[0]);
      w = -eye_z;
    }
  }
};

/// The planes of half a vector of triangles.
struct ExactPlanes {
  Doubles x, y, at;

  [[gnu::always_inline]] ExactPlanes(const ExactCorners& a, const ExactCorners& b, const ExactCorners& c) {
    const Doubles bc[3] = {b.y * c.w - c.y * b.w, b.w * c.x - c.w * b.x, b.x * c.y - c.x * b.y},
                  ca[3] = {c.y * a.w - a.y * c.w, c.w * a.x - a.w * c.x, c.x * a.y - a.x * c.y},
                  ab[3] = {a.y * b.w - b.y * a.w, a.w * b.x - b.w * a.x, a.x * b.y - b.x * a.y};
    const Doubles size = (a.x * bc[0] + a.y * bc[1]) + a.w * bc[2];
    const auto slope = [&](int i) __attribute__((always_inline)) {
      return ((bc[i] * a.z + ca[i] * b.z) + ab[i] * c.z) / size;
    };
    x = slope(0);
    y = slope(1);
    at = slope(2);
  }

  [[gnu::always_inline]] Doubles depths(const TransformTerms& terms, const Corners& corner,
                                        bool upper) const {
    const Doubles to_x = (half(corner.x, upper) - double(terms.middle_x)) / double{terms.scale_x},
                  to_y = (half(corner.y, upper) - double(terms.middle_y)) / double{terms.scale_y};
    const Doubles depth = (x * to_x + y * to_y) + at, snapped = half(corner.depth, upper);
    return magnitude(depth - snapped) <= 0.25 * snapped ? depth : snapped;
  }
};

[[gnu::always_inline]] inline void take_exact_depths(const SetUpTerms& terms, const Ints (&vertices)[3],
                                                     Corners (&corners)[3]) {
  const TransformTerms& transform = *terms.transform;
  Ints lattice[3][3];
  for (int k = 0; k < 3; ++k) {
    lattice[k][0] = gather(terms.lattice.x, vertices[k]) + transform.cell[0];
    lattice[k][1] = gather(terms.lattice.y, vertices[k]) + transform.cell[1];
    lattice[k][2] = gather(terms.lattice.z, vertices[k]) + transform.cell[2];
  }
  Doubles depths[3][2];
  for (int upper = 0; upper < 2; ++upper) {
    const auto exact = [&](int k) __attribute__((always_inline)) {
      return ExactCorners(transform, half(lattice[k][0], upper), half(lattice[k][1], upper),
                          half(lattice[k][2], upper));
    };
    const ExactPlanes planes(exact(0), exact(1), exact(2));
    for (int k = 0; k < 3; ++k) depths[k][upper] = planes.depths(transform, corners[k], upper);
  }
  for (int k = 0; k < 3; ++k) corners[k].depth = to_float(depths[k][0], depths[k][1]);
}

[[gnu::always_inline]] inline Corners select(Ints mask, const Corners& yes, const Corners& no) {
  return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.depth, no.depth)};
}

/// Depths count from the first corner's: from the farthest one that is rounded
/// least.
[[gnu::always_inline]] inline void begin_with_farthest(Corners (&corners)[3]) {
  const auto [a, b, c] = corners;
  const Ints at_b = b.depth < a.depth, at_c = c.depth < select(at_b, b.depth, a.depth);
  corners[0] = select(at_c, c, select(at_b, b, a));
  corners[1] = select(at_c, a, select(at_b, c, b));
  corners[2] = select(at_c, b, select(at_b, a, c));
}

/// Below so many layers.
[[gnu::always_inline]] inline void put_below(const LayerTerms& terms, Ints layers, Prepared& triangles,
                                             PreciseSlopes& slopes) {
  const Ints some = layers > 0;
  if (!any(some)) return;
  Doubles x[2], y[2];
  __builtin_memcpy(&x, slopes.x, sizeof x);
  __builtin_memcpy(&y, slopes.y, sizeof y);
  const Floats slope_x = to_float(x[0], x[1]), slope_y = to_float(y[0], y[1]);
  const Floats to_axis_x = terms.axis_x * 256 - to_float(triangles.first_x),
               to_axis_y = terms.axis_y * 256 - to_float(triangles.first_y);
  const Floats at_axis = (triangles.z + slope_y * to_axis_y) + slope_x * to_axis_x;
  const Floats along_x = (slope_x * 256.0f) * terms.focal_x, along_y = (slope_y * 256.0f) * terms.focal_y,
               ahead = terms.parallel > 0 ? splat(terms.parallel) : at_axis;
  const Floats normal = square_root((along_x * along_x + along_y * along_y) + ahead * ahead);
  const Floats moved = terms.step * normal, sheared = terms.snapped * normal, count = to_float(layers);
  Floats keep = terms.parallel > 0 ? 1.0f - count * terms.depth_rounding
                                   : greater(1.0f - count * (moved + terms.depth_rounding), splat(0.5f)),
         drop = terms.parallel > 0 ? count * (moved + sheared) : count * sheared;
  const auto moved_away = [&](Floats depth) __attribute__((always_inline)) {
    return greater(depth * keep - drop, depth * 0.5f);
  };
  triangles.z = select(some, triangles.z * keep - drop, triangles.z);
  triangles.low = select(some, moved_away(triangles.low), triangles.low);
  triangles.high = select(some, moved_away(triangles.high), triangles.high);
  triangles.plane.error = select(some, triangles.plane.error * 1.5f + 4 * 0x1p-24f * (triangles.high + drop),
                                 triangles.plane.error);
  keep = select(some, keep, splat(1.0f));
  for (int upper = 0; upper < 2; ++upper) {
    x[upper] *= half(keep, upper);
    y[upper] *= half(keep, upper);
  }
  __builtin_memcpy(slopes.x, &x, sizeof x);
  __builtin_memcpy(slopes.y, &y, sizeof y);
}

/// A vector of what set_up() found layered.
[[gnu::always_inline]] inline void make_layered(const SetUpTerms& terms, int32_t from, SetUpResult& result,
                                                RowsOfAll& rows) {
  const Ints there = lane_numbers < result.layered_count - from;
  const Ints triangle =
      select(there, load(result.layered + from), splat(static_cast<int32_t>(result.layered[from])));
  const Ints vertices[3] = {vertices_of(terms.corners.a, triangle), vertices_of(terms.corners.b, triangle),
                            vertices_of(terms.corners.c, triangle)};
  Corners corners[3];
  for (int k = 0; k < 3; ++k) corners[k] = corners_at(terms.points, vertices[k]);
  take_exact_depths(terms, vertices, corners);
  begin_with_farthest(corners);
  const auto& [a, b, c] = corners;
  const Areas area(a, b, c);
  Prepared made(a, b, c, area.rounded > 0, triangle + static_cast<int32_t>(terms.first_slot), terms);
  PreciseSlopes slopes = precise_planes(a, b, c, area, there, made.high, made.plane.error);
  put_below(terms.layer_offset, layers_of(terms, triangle) - 1, made, slopes);
  const Ints ready = there & (PieceLimits(terms, vertices[0]).least_slack(a, b, c) >= made.plane.error);
  append(triangle, there & ~ready, result.rest, result.rest_count);
  if (!any(ready)) return;
  rows.add(made.rows, ready);
  add_wide(made, bits(ready), ready, slopes, result);
}

}  // namespace
}  // namespace triptych
