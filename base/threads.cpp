#include "base/threads.hpp"

#include "base/rounding.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <thread>

namespace triptych {

namespace {
std::unique_ptr<tbb::global_control>& limit() {
  static std::unique_ptr<tbb::global_control> control;
  return control;
}
unsigned limited_to = 0;
}  // namespace

unsigned thread_count_limit() { return limited_to; }

unsigned thread_count() {
  static const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
  return limited_to == 0 ? cores : limited_to;
}

void set_thread_count(unsigned count) {
  limit().reset();
  limited_to = count;
  if (count > 0)
    limit() = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, count);
}

namespace {

/// loop: calls its argument for each index.
template <typename Loop>
void run_parallel(const std::function<void(size_t)>& body, const Loop& loop) {
  // Exceptions must not reach TBB: it would also cancel nested work in the bodies, such as the build of an
  // Embree tree, which would then seem to be complete.
  std::atomic<bool> failed = false;
  std::mutex mutex;
  std::exception_ptr first;
  loop([&](size_t i) {
    if (failed) return;
    const NearestRounding rounding;  // threads have the mode of the thread that first woke them
    try {
      body(i);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!first) first = std::current_exception();
      failed = true;
    }
  });
  if (first) std::rethrow_exception(first);
}

}  // namespace

void parallel_for(size_t count, const std::function<void(size_t)>& body) {
  run_parallel(body, [&](const auto& one) { tbb::parallel_for(size_t{0}, count, one); });
}

struct ThreadAffinity::Partitioner {
  tbb::affinity_partitioner of_tbb;
};
ThreadAffinity::ThreadAffinity() : partitioner_(std::make_unique<Partitioner>()) {}
ThreadAffinity::~ThreadAffinity() = default;

void parallel_for(size_t count, const std::function<void(size_t)>& body, ThreadAffinity& affinity) {
  run_parallel(body, [&](const auto& one) {
    tbb::parallel_for(size_t{0}, count, one, affinity.partitioner().of_tbb);
  });
}

}  // namespace triptych
