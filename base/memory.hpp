// What the kernel says that this process uses.
#pragma once

#include <cstdint>

namespace triptych {

/// The largest resident size of this process so far, in bytes (VmHWM).
uint64_t peak_resident_bytes();

/// Gives back to the system what was freed: the allocator keeps it otherwise, for more of the same.
void release_freed_memory();

}  // namespace triptych
