// The kernels of the instruction set that the including file is compiled for.
#pragma once

#include "raster/simd/color_row.hpp"
#include "raster/simd/fill.hpp"
#include "raster/simd/find_candidates.hpp"
#include "raster/simd/kernels.hpp"
#include "raster/simd/set_up.hpp"
#include "raster/simd/test_box.hpp"
#include "raster/simd/transform_vertices.hpp"

namespace triptych {
namespace {

constexpr RasterKernels kernels_here = {.transform_vertices = transform_vertices,
                                        .find_candidates = find_candidates,
                                        .set_up = set_up,
                                        .fill_narrow = fill_narrow,
                                        .fill_fragments = fill_fragments,
                                        .fill = fill,
                                        .least_of_tile = least_of_tile,
                                        .color_row = color_row,
                                        .hides = hides,
                                        .count_box = count_box};

}  // namespace
}  // namespace triptych
