// How often this thread asked the allocator for memory.
#pragma once

#include <cstdint>

namespace triptych {

/// Whether allocations are counted here: not under sanitizers, which have an allocator of their own. Counted
/// in programs that link triptych_allocation_count, which replaces the global operator new.
bool allocations_are_counted();

/// Calls of operator new in this thread so far.
uint64_t allocation_count();

}  // namespace triptych
