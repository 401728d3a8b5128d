// Time that this process spent, and time that others took.
#include "base/spent_time.hpp"

#include <gtest/gtest.h>
#include <thread>

namespace triptych {
namespace {

TEST(SpentTime, work_takes_processor_time_and_sleep_takes_none) {
  const SpentTime before = spent_time();
  // Until the process has had 5 ms of a processor, however busy the machine is.
  while (spent_time().cpu_ms - before.cpu_ms < 5) {
  }
  const SpentTime worked = spent_time() - before;
  EXPECT_GE(worked.cpu_ms, 5);
  EXPECT_GT(worked.wall_ms, 0);
  const SpentTime asleep = spent_time();
  std::this_thread::sleep_for(std::chrono::milliseconds(40));
  const SpentTime slept = spent_time() - asleep;
  EXPECT_GE(slept.wall_ms, 39.9);
  EXPECT_LT(slept.cpu_ms, slept.wall_ms);
}

TEST(SpentTime, differences_are_never_below_0) {
  const SpentTime none = SpentTime{1, 1, 1, 1} - SpentTime{2, 2, 2, 2};
  EXPECT_EQ(none.wall_ms + none.cpu_ms + none.waiting_ms + none.stolen_ms, 0);
}

TEST(SpentTime, waiting_theft_and_other_running_threads_disturb) {
  const SpentTime before{};
  const SpentTime quiet{.wall_ms = 100, .cpu_ms = 50};
  EXPECT_TRUE(is_undisturbed(before, quiet));
  SpentTime waited = quiet, stolen = quiet, crowded = quiet, crowd = before;
  waited.waiting_ms = 2.5;
  stolen.stolen_ms = 10;
  crowded.runnable = crowd.runnable = 1 + std::thread::hardware_concurrency();
  EXPECT_FALSE(is_undisturbed(before, waited));
  EXPECT_FALSE(is_undisturbed(before, stolen));
  EXPECT_FALSE(is_undisturbed(before, crowded));
  EXPECT_FALSE(is_undisturbed(crowd, quiet));
}

}  // namespace
}  // namespace triptych
