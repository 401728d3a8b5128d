// Baking that is killed goes on where it was.
#include "preprocess/light_units.hpp"

#include "base/file.hpp"
#include "base/threads.hpp"

#include <atomic>
#include <filesystem>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace triptych {
namespace {

constexpr uint32_t batch = LightUnits::unit_points * LightUnits::batch_units;
constexpr uint32_t count = 2 * batch + batch / 2;

void value_of(uint32_t item, std::vector<float>& values) {
  values.push_back(static_cast<float>(item));
  values.push_back(-1);
}

TEST(LightUnits, what_was_gathered_before_a_kill_is_not_gathered_again) {
  const auto folder =
      std::filesystem::path(testing::TempDir()) / ("triptych_light_" + std::to_string(::getpid()));
  make_folder(folder);
  const pid_t child = ::fork();
  if (child == 0) {
    set_thread_count(1);
    BuildWork work(folder / "a.tpk", "same");
    LightUnits units(work);
    units.run("first", 300, value_of);
    units.run("second", count, [](uint32_t item, std::vector<float>& values) {
      if (item == 2 * batch + 1000) ::_exit(0);
      value_of(item, values);
    });
    ::_exit(1);
  }
  int status = 1;
  ::waitpid(child, &status, 0);
  ASSERT_EQ(status, 0);
  BuildWork work(folder / "a.tpk", "same");
  LightUnits units(work);
  std::atomic<uint32_t> gathered = 0, least = count;
  const auto counted = [&](uint32_t item, std::vector<float>& values) {
    ++gathered;
    for (uint32_t seen = least; item < seen && !least.compare_exchange_weak(seen, item);) {
    }
    value_of(item, values);
  };
  EXPECT_EQ(units.run("first", 300, counted).size(), 600u);
  EXPECT_EQ(gathered, 0u);
  const std::vector<float> values = units.run("second", count, counted);
  EXPECT_EQ(gathered, count - 2 * batch);
  EXPECT_EQ(least, 2 * batch);
  std::vector<float> expected;
  for (uint32_t i = 0; i < count; ++i) value_of(i, expected);
  EXPECT_EQ(values, expected);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace triptych
