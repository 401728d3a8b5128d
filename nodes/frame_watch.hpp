// Says that a frame is still being drawn, where one takes long.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace triptych {

/// Prints a line on standard error every few seconds of a frame, from a thread of its own: nothing for quick
/// frames. Where no thread can be had, it says nothing.
class FrameWatch {
 public:
  /// who: begins the line.
  explicit FrameWatch(std::string who, std::chrono::milliseconds every = std::chrono::seconds(5));
  ~FrameWatch();
  FrameWatch(const FrameWatch&) = delete;
  FrameWatch& operator=(const FrameWatch&) = delete;

  void begin(uint32_t frame);
  void end();

 private:
  using Clock = std::chrono::steady_clock;
  struct Frame {
    uint32_t number;
    Clock::time_point since;
  };
  void work();

  std::string who_;
  std::chrono::milliseconds every_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Frame> frame_;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace triptych
