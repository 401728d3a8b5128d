// How often this thread asked the allocator for memory.
#pragma once

#include <cstdint>

namespace triptych {

/// Whether allocations are counted: in programs that link triptych_allocation_count, which replaces the
/// global operator new, but not under sanitizers.
bool allocations_are_counted();

/// Calls of operator new in this thread so far.
uint64_t allocation_count();

/// Called by the counting operator new.
void count_allocation() noexcept;

}  // namespace triptych
