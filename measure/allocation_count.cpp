#include "measure/allocation_count.hpp"

namespace triptych {

namespace {
thread_local uint64_t count = 0;
}  // namespace

void count_allocation() noexcept { ++count; }
// Every thread that runs has allocated something, if anybody counts.
bool allocations_are_counted() { return count > 0; }
uint64_t allocation_count() { return count; }

}  // namespace triptych
