// How fast frames are, beside other ways of drawing the same ones: in one process, frame by frame in turn.
#pragma once

#include "measure/device_methods.hpp"
#include "measure/speed_method.hpp"
#include "scene/pack.hpp"

#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace triptych {

/// What a method did, frame by frame.
struct SpeedSeries {
  std::string method, device;  ///< device: empty where none draws
  struct Frame {
    double frame_ms = 0;  ///< wall clock
    double cpu_ms = 0;    ///< of all threads of the process
    uint64_t drawn_triangles = 0;
    std::vector<SpeedStage> stages;
  };
  std::vector<Frame> frames{};  ///< without those of the warm-up
  std::string missing{};        ///< why there are none: no memory, or no OpenGL
};

struct SpeedOptions {
  std::vector<std::string> methods{};  ///< those to measure; all where it is empty
  size_t warm_up = 3;                  ///< so many frames of the path are drawn and left out; one is left
  uint64_t max_memory_bytes = std::numeric_limits<uint64_t>::max();  ///< for the whole model and its tree
  std::string no_opengl{};  ///< why `everything` cannot be drawn; empty where a context is current
};

/// Every method's name: `everything`, `frustum`, `triptych`, `oracle`, `embree`.
const std::vector<std::string>& speed_method_names();

/// Draws each frame by each method, on each device where the method takes one, one after the other; frame by
/// frame another one begins. All frames have one size, and hide the same; there is at least one. Chunks are
/// loaded beforehand, shaders are made and trees built before the first frame that counts.
std::vector<SpeedSeries> measure_speed(const Pack& pack, std::span<const SpeedDevice> devices,
                                       std::span<const FrameRequest> frames, const SpeedOptions& options);

/// The rows: {"method", "device", "frame_ms", "cpu_ms", "drawn_triangles", "stages_ms"}; without a device
/// where none draws; null, and "why", where the model does not fit or there is no OpenGL.
nlohmann::json speed_rows(const std::vector<SpeedSeries>& series);

/// Ratios frame by frame, of which the median: `triptych_over_embree`, `triptych_over_oracle` and so on,
/// where triptych and what is of a device are of the one named; `gl_over_cpu`;
/// `triptych_triangles_over_oracle`; besides, `p95_over_median` of triptych's frame times. What cannot be
/// formed is left out.
nlohmann::json speed_ratios(const std::vector<SpeedSeries>& series, const std::string& device);

}  // namespace triptych
