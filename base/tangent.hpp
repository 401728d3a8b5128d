// The tangent, the same to the bit on every processor.
#pragma once

namespace triptych {

/// tan(radians) for −π/2 < radians < π/2, by additions, multiplications and one division alone; off by a few
/// units in the last place. The C library's differs between processors with and without fused
/// multiplication.
double tangent(double radians);

}  // namespace triptych
