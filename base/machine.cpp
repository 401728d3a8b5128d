#include "base/machine.hpp"

#include <algorithm>
#include <ctime>
#include <fstream>
#include <sched.h>
#include <unistd.h>

namespace triptych {

Machine this_machine() {
  Machine machine;
  std::ifstream facts("/proc/cpuinfo");
  for (std::string line; machine.processor.empty() && std::getline(facts, line);) {
    if (line.starts_with("model name"))
      machine.processor = line.substr(std::min(line.size(), line.find(": ") + 2));
  }
  cpu_set_t usable;
  CPU_ZERO(&usable);
  if (::sched_getaffinity(0, sizeof(usable), &usable) == 0)
    machine.cores = static_cast<unsigned>(CPU_COUNT(&usable));
  const long pages = ::sysconf(_SC_PHYS_PAGES), page = ::sysconf(_SC_PAGESIZE);
  if (pages > 0 && page > 0)
    machine.memory_bytes = static_cast<uint64_t>(pages) * static_cast<uint64_t>(page);
  return machine;
}

std::string date_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  ::gmtime_r(&now, &parts);
  std::string text(32, '\0');
  text.resize(std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M UTC", &parts));
  return text;
}

}  // namespace triptych
