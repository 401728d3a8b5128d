#include "base/memory.hpp"

#include <algorithm>
#include <fstream>
#include <limits>
#include <malloc.h>
#include <string>
#include <sys/resource.h>
#include <unistd.h>

namespace triptych {

uint64_t resident_bytes() {
  uint64_t size = 0, resident = 0;  // pages
  std::ifstream("/proc/self/statm") >> size >> resident;
  return resident * static_cast<uint64_t>(::sysconf(_SC_PAGESIZE));
}

uint64_t peak_resident_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<uint64_t>(usage.ru_maxrss) * 1024;
}

uint64_t available_memory_bytes() {
  uint64_t available = std::numeric_limits<uint64_t>::max();
  std::ifstream meminfo("/proc/meminfo");
  for (std::string key, rest; meminfo >> key; std::getline(meminfo, rest)) {
    uint64_t kib = 0;
    if (key == "MemAvailable:" && meminfo >> kib) available = kib * 1024;
  }
  uint64_t limit = 0, used = 0;  // of a control group, where there is one with a limit
  if (std::ifstream("/sys/fs/cgroup/memory.max") >> limit &&
      std::ifstream("/sys/fs/cgroup/memory.current") >> used)
    available = std::min(available, limit - std::min(limit, used));
  return available;
}

void release_freed_memory() { ::malloc_trim(0); }

void keep_freed_memory_below(uint64_t bytes) {
  constexpr uint64_t max_threshold = 32u << 20;  // the allocator accepts no more
  ::mallopt(M_TRIM_THRESHOLD, static_cast<int>(std::min(bytes, 2 * max_threshold)));
  ::mallopt(M_MMAP_THRESHOLD, static_cast<int>(std::min(bytes / 8, max_threshold)));
}

}  // namespace triptych
