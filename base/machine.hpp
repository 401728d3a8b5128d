// What this machine is, for reports.
#pragma once

#include <cstdint>
#include <string>

namespace triptych {

struct Machine {
  std::string processor;  ///< as the kernel calls it; empty where it does not say
  unsigned cores = 0;     ///< that this process may use
  uint64_t memory_bytes = 0;
};
Machine this_machine();

/// "2026-03-01 14:05 UTC".
std::string date_now();

}  // namespace triptych
