// The faults that a test can put into a role of a session.
#pragma once

#include <chrono>
#include <thread>

namespace triptych {

/// The defaults are correct; any other value is a fault that a check must notice, or that must not change any
/// picture.
struct SessionRules {
  bool compares_digests = true;  ///< a receiver asks for the full set where its digest differs
  /// HC leaves the last added id out of each packet after computing the digest.
  bool withholds_added = false;
  std::chrono::milliseconds slowed_by{0};  ///< the delay before each packet and each frame

  void slow_down() const {
    if (slowed_by.count() > 0) std::this_thread::sleep_for(slowed_by);
  }
};

}  // namespace triptych
