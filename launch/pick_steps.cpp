#include "launch/pick_steps.hpp"

#include "base/clock.hpp"
#include "nodes/local_pipeline.hpp"
#include "view/snap.hpp"

#include <algorithm>
#include <limits>

namespace triptych {

namespace {

/// The least of three runs behind a first one, which reads chunks.
template <typename Body>
double microseconds(const Body& body) {
  body();
  double least = std::numeric_limits<double>::infinity();
  for (int run = 0; run < 3; ++run) {
    const Stopwatch stopwatch;
    body();
    least = std::min(least, stopwatch.milliseconds() * 1000);
  }
  return least;
}

}  // namespace

std::vector<PickSamples> measure_picks(const Pack& pack, std::span<const FrameRequest> frames,
                                       const DeviceOptions& device) {
  constexpr int places = 5;
  Picker picker(pack);
  const View& first = frames.front().state.view;
  LocalPipeline pipeline(pack, {.width = first.width, .height = first.height, .device = device});
  std::vector<PickSamples> samples;
  for (const FrameRequest& frame : frames) {
    const View& view = frame.state.view;
    const VisibleSet shown = pipeline.draw(frame).visible;
    PickSamples slowest{};
    for (int i = 0; i < places * places; ++i) {
      const glm::dvec2 cursor(view.width * (i % places + 0.5) / places,
                              view.height * (i / places + 0.5) / places);
      slowest[0] =
          std::max(slowest[0], microseconds([&] { return picker.at({view}, shown, cursor.x, cursor.y); }));
      slowest[1] = std::max(slowest[1], microseconds([&] {
                              return snap(NearCursor(pack.skeleton(), picker.chunks(), frame.state, shown,
                                                     cursor, snap_pixels));
                            }));
    }
    samples.push_back(slowest);
  }
  return samples;
}

}  // namespace triptych
