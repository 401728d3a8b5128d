#include "base/memory.hpp"

#include <malloc.h>
#include <sys/resource.h>

namespace triptych {

uint64_t peak_resident_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<uint64_t>(usage.ru_maxrss) * 1024;
}

void release_freed_memory() { ::malloc_trim(0); }

}  // namespace triptych
