// The kernels of the instruction set that the including file is compiled for.
#pragma once

#include "raster/simd/fill_rows.hpp"
#include "raster/simd/kernels.hpp"
#include "raster/simd/test_pixels.hpp"
#include "raster/simd/transform_vertices.hpp"

namespace triptych {
namespace {

constexpr RasterKernels kernels_here = {.min_width = lanes,
                                        .transform_vertices = transform_vertices,
                                        .fill_depths = fill_depths,
                                        .fill_words = fill_words,
                                        .test_depths = test_depths,
                                        .test_words = test_words};

}  // namespace
}  // namespace triptych
