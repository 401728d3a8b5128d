#include "nodes/frame_watch.hpp"

#include "base/notice.hpp"
#include "base/thread_name.hpp"

#include <system_error>

namespace triptych {

FrameWatch::FrameWatch(std::string who, std::chrono::milliseconds every)
    : who_(std::move(who)), every_(every) {
  try {
    thread_ = std::thread([this] { work(); });
  } catch (const std::system_error&) {  // frames are drawn without it, too
  }
}

FrameWatch::~FrameWatch() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

// Neither wakes the thread: it looks at the clock by itself, so that quick frames cost nothing.
void FrameWatch::begin(uint32_t frame) {
  const std::lock_guard lock(mutex_);
  frame_ = {frame, Clock::now()};
}

void FrameWatch::end() {
  const std::lock_guard lock(mutex_);
  frame_.reset();
}

void FrameWatch::work() {
  name_thread("frame-watch");
  std::unique_lock lock(mutex_);
  std::optional<Clock::time_point> told_of;
  auto next = Clock::now();
  while (!ending_) {
    if (frame_ && told_of != frame_->since) {
      told_of = frame_->since;
      next = frame_->since + every_;
    }
    const auto now = Clock::now();
    if (frame_ && now >= next) {
      notice("{}: frame {} has taken {:.3g} s so far", who_, frame_->number,
             std::chrono::duration<double>(now - frame_->since).count());
      next += every_;
    }
    changed_.wait_for(lock, every_ / 4);
  }
}

}  // namespace triptych
