#include "measure/frame_series.hpp"

#include <cmath>

namespace triptych {

nlohmann::json frame_series(const std::vector<FrameRecord>& frames) {
  using nlohmann::json;
  json times = json::array(), cuts = json::array(), visible = json::array(), changed = json::array(),
       triangles = json::array();
  for (const FrameRecord& frame : frames) {
    times.push_back(std::round(frame.frame_ms * 1000) / 1000);
    cuts.push_back(frame.cut_drawables);
    visible.push_back(frame.visible.size());
    changed.push_back(frame.added + frame.removed);
    triangles.push_back(frame.drawn_triangles);
  }
  return {{"frame_ms", times},
          {"cut", cuts},
          {"visible", visible},
          {"changed", changed},
          {"drawn_triangles", triangles}};
}

}  // namespace triptych
