// Compiled for this instruction set: no code that other files share may be instantiated here.
#include "raster/simd/fill_rows.hpp"
#include "raster/simd/kernels.hpp"
#include "raster/simd/test_pixels.hpp"
#include "raster/simd/transform_vertices.hpp"

namespace triptych {

extern const RasterKernels avx512_kernels = {.min_width = lanes,
                                             .transform_vertices = transform_vertices,
                                             .fill_depths = fill_depths,
                                             .fill_words = fill_words,
                                             .test_depths = test_depths,
                                             .test_words = test_words};

}  // namespace triptych
