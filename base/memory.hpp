// The memory of this process.
#pragma once

#include <cstdint>

namespace triptych {

/// The resident size of this process now, in bytes.
uint64_t resident_bytes();

/// The largest resident size of this process so far, in bytes (VmHWM).
uint64_t peak_resident_bytes();

/// What this process may still take without swapping or running into its control group's limit, in bytes.
uint64_t available_memory_bytes();

/// Returns freed memory to the system, which the allocator would otherwise keep for later.
void release_freed_memory();

/// From now on the allocator keeps at most about this many bytes of what is freed, and returns large blocks
/// at once.
void keep_freed_memory_below(uint64_t bytes);

}  // namespace triptych
