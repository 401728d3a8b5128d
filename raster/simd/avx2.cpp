// Compiled for this instruction set: no code that other files share may be instantiated here.
#include "raster/simd/kernels_here.hpp"

namespace triptych {

extern const RasterKernels avx2_kernels = kernels_here;

}  // namespace triptych
