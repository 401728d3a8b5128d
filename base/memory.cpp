#include "base/memory.hpp"

#include <algorithm>
#include <malloc.h>
#include <sys/resource.h>

namespace triptych {

uint64_t peak_resident_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<uint64_t>(usage.ru_maxrss) * 1024;
}

void release_freed_memory() { ::malloc_trim(0); }

void keep_freed_memory_below(uint64_t bytes) {
  constexpr uint64_t max_threshold = 32u << 20;  // the allocator accepts no more
  ::mallopt(M_TRIM_THRESHOLD, static_cast<int>(std::min(bytes, 2 * max_threshold)));
  ::mallopt(M_MMAP_THRESHOLD, static_cast<int>(std::min(bytes / 8, max_threshold)));
}

}  // namespace triptych
