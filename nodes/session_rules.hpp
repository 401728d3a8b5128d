// What a role of a session does beside its work: nothing, unless a test puts a fault in.
#pragma once

#include <chrono>
#include <thread>

namespace triptych {

/// The defaults are right; everything else is a fault that a check must notice, or that no picture may show.
struct SessionRules {
  bool compares_digests = true;  ///< a receiver asks for the full set where its digest differs
  bool withholds_added = false;  ///< HC leaves the last added id out of each packet, after the digest
  std::chrono::milliseconds slowed_by{0};  ///< with each packet and each frame

  void slow_down() const {
    if (slowed_by.count() > 0) std::this_thread::sleep_for(slowed_by);
  }
};

}  // namespace triptych
