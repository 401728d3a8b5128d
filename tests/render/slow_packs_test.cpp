// Frames from a pack whose chunks come slowly, or from afar.
#include "nodes/local_pipeline.hpp"
#include "tests/support/hooked_source.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/test_device.hpp"

#include <condition_variable>
#include <filesystem>
#include <gtest/gtest.h>
#include <mutex>
#include <thread>

namespace triptych {
namespace {

constexpr int width = 96, height = 80;

/// Lets reads through, or keeps them waiting.
class Gate {
 public:
  void set(bool open) {
    const std::lock_guard lock(mutex_);
    open_ = open;
    changed_.notify_all();
  }
  void pass() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return open_; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool open_ = true;
};

class SlowPacks : public testing::Test {
 protected:
  SlowPacks() { scenes::write_pack("room", file); }
  ~SlowPacks() override { std::filesystem::remove(file); }

  Pack pack(std::function<void(const std::string&)> before, ByteSource::Habits habits = {}) const {
    auto source = std::make_unique<test::HookedSource>(file, habits);
    source->before = std::move(before);
    return Pack(std::move(source));
  }
  static std::unique_ptr<LocalPipeline> pipeline(const Pack& pack, OnMiss on_miss) {
    DeviceOptions device = test::device();
    device.memory.on_miss = on_miss;
    return std::make_unique<LocalPipeline>(
        pack, LocalPipelineOptions{.width = width, .height = height, .device = device});
  }
  static std::vector<uint8_t> picture_at_rest(LocalPipeline& pipeline, const FrameRequest& frame) {
    while (pipeline.draw(frame).gets_finer) std::this_thread::yield();
    return pipeline.target().read_colors();
  }

  const std::filesystem::path file = testing::TempDir() + "triptych_slow_" + std::to_string(::getpid()) +
                                     testing::UnitTest::GetInstance()->current_test_info()->name() + ".tpk";
};

TEST_F(SlowPacks, no_frame_waits_for_a_disk_that_gives_nothing_and_what_comes_later_is_drawn) {
  Gate gate;
  const Pack slow = pack([&](const std::string& place) {
    if (place.find("chunk") != std::string::npos) gate.pass();
  });
  const Pack whole(file);
  const auto hasty = pipeline(slow, OnMiss::coarser), exact = pipeline(whole, OnMiss::exact);
  const std::vector<View> views = scenes::path(slow.skeleton(), width, height);
  for (uint32_t i = 0; i < 6; ++i) picture_at_rest(*hasty, {i, {views[i], 4096}});
  gate.set(false);
  for (uint32_t i = 1; i < 6; ++i) {  // which would never end, if it waited
    const FrameRecord& record = hasty->draw({i, {views[i], 0.5}});
    EXPECT_GT(record.owed_drawables, 0u) << i;
    EXPECT_TRUE(record.gets_finer) << i;
    EXPECT_GT(record.drawn_triangles, 0u) << i;
  }
  gate.set(true);
  const FrameRequest last{6, {views[5], 0.5}};
  const std::vector<uint8_t> picture = picture_at_rest(*hasty, last);
  exact->draw(last);
  EXPECT_EQ(picture, exact->target().read_colors());
}

TEST_F(SlowPacks, that_are_far_are_drawn_exactly) {
  const Pack far = pack([](const std::string&) {},
                        {.threads = 4, .most_at_once = 1 << 20, .unasked = 1 << 14, .far = true});
  const Pack near(file);
  const auto remote = pipeline(far, OnMiss::exact), local = pipeline(near, OnMiss::exact);
  const std::vector<View> views = scenes::path(far.skeleton(), width, height);
  for (uint32_t i = 0; i < 12; ++i) {
    remote->draw({i, {views[i], 1}});
    local->draw({i, {views[i], 1}});
    ASSERT_EQ(remote->target().read_colors(), local->target().read_colors()) << i;
  }
  EXPECT_GT(remote->memory().read_ahead.read_ahead, 0u) << "nothing was read by threads";
}

}  // namespace
}  // namespace triptych
