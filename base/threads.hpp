// Work over all cores. Results never depend on the number of threads: each index only writes its own result.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace triptych {

/// Limits parallel_for for the rest of the process; 0 is all cores.
void set_thread_count(unsigned count);
/// The limit that was set last; 0 is all cores.
unsigned thread_count_limit();
/// How many threads that is; at least 1.
unsigned thread_count();

/// Calls body(0) … body(count − 1), in any order, side by side, each rounding to nearest; the first exception
/// is thrown again here.
void parallel_for(size_t count, const std::function<void(size_t)>& body);

/// Remembers which thread worked at which index, so that what is in a core's caches is found there again.
class ThreadAffinity {
 public:
  ThreadAffinity();
  ~ThreadAffinity();

  struct Partitioner;
  Partitioner& partitioner() { return *partitioner_; }

 private:
  std::unique_ptr<Partitioner> partitioner_;
};
/// The same, each index where possible by the thread that had it last time.
void parallel_for(size_t count, const std::function<void(size_t)>& body, ThreadAffinity& affinity);

}  // namespace triptych
