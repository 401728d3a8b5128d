#include "measure/allocation_count.hpp"

namespace triptych {

namespace {
thread_local uint64_t count = 0;
}  // namespace

void count_allocation() noexcept { ++count; }
// Every running thread has allocated something, so the count is above 0 if allocations are counted.
bool allocations_are_counted() { return count > 0; }
uint64_t allocation_count() { return count; }

}  // namespace triptych
