#include "measure/session_faults.hpp"

namespace triptych {

nlohmann::json faults_json(const std::vector<FrameRecord>& frames) {
  nlohmann::json faults = nlohmann::json::array();
  double second = 0;
  bool alone = false;
  for (const FrameRecord& frame : frames) {
    if (frame.fallback && !alone) {
      faults.push_back({{"frame", frame.number},
                        {"second", second},
                        {"reason", frame.lost},
                        {"frames_alone", 0},
                        {"alone_ms", 0.0},
                        {"back_at_frame", nullptr}});
    } else if (frame.fallback && !frame.lost.empty()) {
      nlohmann::json& reason = faults.back()["reason"];
      reason = reason.get<std::string>() + "; " + frame.lost;
    }
    if (frame.fallback) {
      faults.back()["frames_alone"] = faults.back()["frames_alone"].get<uint64_t>() + 1;
      faults.back()["alone_ms"] = faults.back()["alone_ms"].get<double>() + frame.frame_ms;
    } else if (alone) {
      faults.back()["back_at_frame"] = frame.number;
    }
    alone = frame.fallback;
    second += frame.frame_ms / 1000;
  }
  return faults;
}

}  // namespace triptych
