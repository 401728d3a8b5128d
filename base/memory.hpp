// What the kernel says that this process uses.
#pragma once

#include <cstdint>

namespace triptych {

/// The largest resident size of this process so far, in bytes (VmHWM).
uint64_t peak_resident_bytes();

}  // namespace triptych
