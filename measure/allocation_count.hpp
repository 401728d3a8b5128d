// How often this thread asked the allocator for memory.
#pragma once

#include <cstdint>

namespace triptych {

/// Whether anybody counts: programs that link triptych_allocation_count do, which replaces the global
/// operator new, but not under sanitizers.
bool allocations_are_counted();

/// Calls of operator new in this thread so far.
uint64_t allocation_count();

/// For the operator new that counts.
void count_allocation() noexcept;

}  // namespace triptych
