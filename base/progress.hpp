// Progress on standard error: one line that is updated on a terminal, plain lines elsewhere.
#pragma once

#include "base/clock.hpp"

#include <cstdint>
#include <string>

namespace triptych {

/// One stage of work. Threads may call advance(); a line appears at most a few times a second on a terminal,
/// every few seconds elsewhere, and once at the end.
class Progress {
 public:
  /// total: how many steps there are; 0 if that is not known.
  explicit Progress(std::string stage, uint64_t total = 0);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void advance(uint64_t steps = 1);
  double seconds() const { return stopwatch_.seconds(); }

 private:
  void print(uint64_t done, bool last) const;
  std::string stage_;
  uint64_t total_;
  uint64_t done_ = 0;
  double next_print_ = 0;
  Stopwatch stopwatch_;
};

}  // namespace triptych
