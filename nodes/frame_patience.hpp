// How long a visible set is waited for: by what frames take.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <fmt/core.h>
#include <string>

namespace triptych {

/// Large pictures take every role longer, and nobody is lost because of that. What counts is work that was
/// measured, here and by the switch nodes, never time spent waiting: a role that hangs does not stretch it.
class FramePatience {
 public:
  /// least: the limit where frames are quick.
  explicit FramePatience(std::chrono::milliseconds least) : least_(least) {}

  /// The slowest role worked so long at a frame.
  void worked(double milliseconds) { recent_[next_++ % recent_.size()] = milliseconds; }
  /// Four times what the slowest of the last eight frames took, or the least.
  std::chrono::milliseconds limit() const {
    constexpr double times = 4;
    return std::max(least_, std::chrono::milliseconds(static_cast<int64_t>(times * longest())));
  }
  /// Where the limit comes from.
  std::string reason() const {
    const auto given = fmt::format("--timeout {}", least_.count());
    return limit() == least_ ? given : fmt::format("{}, stretched for frames of {:.0f} ms", given, longest());
  }

 private:
  double longest() const { return *std::max_element(recent_.begin(), recent_.end()); }

  std::chrono::milliseconds least_;
  std::array<double, 8> recent_{};
  size_t next_ = 0;
};

}  // namespace triptych
