#include "launch/pick_steps.hpp"

#include "base/clock.hpp"
#include "lod/cut.hpp"
#include "lod/frame_view.hpp"
#include "view/snap.hpp"

#include <algorithm>

namespace triptych {

namespace {

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Of the second of two runs.
template <typename Body>
double microseconds(const Body& body) {
  body();
  const Stopwatch stopwatch;
  body();
  return stopwatch.milliseconds() * 1000;
}

}  // namespace

std::vector<PickSamples> measure_picks(const Pack& pack, std::span<const FrameRequest> frames) {
  constexpr int places = 5;
  Picker picker(pack);
  std::vector<PickSamples> samples;
  for (const FrameRequest& frame : frames) {
    const View& view = frame.state.view;
    const std::vector<DrawableId> shown = select_cut(FrameView(pack.skeleton(), frame.state)).drawables;
    std::vector<double> picks, snaps;
    for (int i = 0; i < places * places; ++i) {
      const glm::dvec2 cursor(view.width * (i % places + 0.5) / places,
                              view.height * (i / places + 0.5) / places);
      picks.push_back(microseconds([&] { return picker.at({view}, shown, cursor.x, cursor.y); }));
      snaps.push_back(microseconds([&] {
        return snap(NearCursor(pack.skeleton(), picker.chunks(), frame.state, shown, cursor, snap_pixels));
      }));
    }
    samples.push_back({median(picks), median(snaps)});
  }
  return samples;
}

}  // namespace triptych
