// What the kernel says that this process uses.
#pragma once

#include <cstdint>

namespace triptych {

/// The largest resident size of this process so far, in bytes (VmHWM).
uint64_t peak_resident_bytes();

/// What this process may still take without swapping or running into its control group's limit, in bytes.
uint64_t available_memory_bytes();

/// Gives back to the system what was freed: the allocator keeps it otherwise, for more of the same.
void release_freed_memory();

/// From now on the allocator keeps about so many bytes of what is freed, instead of ever more, and large
/// blocks go back at once.
void keep_freed_memory_below(uint64_t bytes);

}  // namespace triptych
