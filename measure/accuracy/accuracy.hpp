// What accuracy costs in time: one path at many settings, each frame compared with the picture of the full
// detail.
#pragma once

#include "measure/accuracy/picture_tally.hpp"
#include "measure/device_methods.hpp"
#include "scene/frame_state.hpp"
#include "scene/pack.hpp"
#include "visibility/strategy.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace triptych {

/// A way to choose what is drawn, as one of several that are measured.
struct AccuracyStrategy {
  std::string name;
  uint32_t min_pixels = 0;  ///< what an approximate one was asked for; 0: it has no such setting
  /// For a pack, and its hierarchy on one of the devices.
  std::function<std::unique_ptr<Strategy>(const Pack&, const Hierarchy&)> make;
};

/// A pack and the devices that draw it. Packs of one model differ in how they were built.
struct AccuracySubject {
  std::string name;
  std::string representation;  ///< how its geometry gets finer and coarser: Representation::name()
  const Pack& pack;
  std::vector<SpeedDevice> devices;
  std::optional<double> build_seconds{};  ///< where it was built for this
  Hiding hiding{};                        ///< what is hidden of it, in place of what frames say
};

struct AccuracyOptions {
  std::vector<double> pixel_errors;  ///< each > 0
  std::vector<AccuracyStrategy> strategies;
  size_t compared_frames = 20;      ///< so many frames of the path are compared; all are timed
  size_t points = 20000;            ///< pixels of a picture at which distances are measured, each way; 0: all
  size_t shifts = 4;                ///< of the camera, by parts of a pixel; 0: cover is not measured
  size_t perceptual_frames = 3;     ///< of the compared ones: those that butteraugli is asked about
  std::filesystem::path scratch{};  ///< a folder for its pictures
};

/// One setting, and what it costs and spoils.
struct AccuracyRow {
  std::string pack, strategy, representation, device;
  PackOptions build{};  ///< how the pack was built, as it says
  std::optional<double> build_seconds{};
  uint64_t pack_bytes = 0;
  std::string may_miss{};  ///< of an approximate strategy: what, in its own words
  uint32_t min_pixels = 0;
  int width = 0, height = 0;
  uint32_t samples = 1;  ///< a pixel, of the reference, too
  double pixel_error = 1;

  struct Frame {
    double frame_ms = 0;  ///< wall clock
    double cpu_ms = 0;    ///< of all threads of the process
    double occlusion_representation_ms = 0, hardware_cull_ms = 0, render_ms = 0;
    uint64_t drawn_triangles = 0, drawables = 0;
  };
  std::vector<Frame> frames{};
  std::shared_ptr<PictureTally> pictures{};  ///< exact strategies share the one of the whole cut
  /// Triangles of drawables that own a pixel of the whole cut's picture, and of those the ones that were not
  /// drawn; over the compared frames.
  uint64_t owning_triangles = 0, missed_triangles = 0;
};

/// A promise that was not kept.
struct AccuracyViolation {
  size_t row = 0;
  std::string what;
  uint32_t frame = 0;
  /// What deviates, or what is there in the largest patch; its pixels are by how much, or of the patch.
  PointDeviation point{};
};

/// One frame at one pixel error, for people to look at.
struct AccuracyPicture {
  double pixel_error = 0;  ///< 0: the reference
  uint32_t frame = 0;
  int width = 0, height = 0;
  std::vector<uint8_t> colors;
};

struct AccuracyResult {
  std::vector<AccuracyRow> rows;
  std::vector<AccuracyViolation> violations;
  std::vector<AccuracyPicture> pictures;  ///< of the first pack, device and path: the frame in the middle
  bool perceptual = false;                ///< whether butteraugli was there
};

/// Draws every frame at every setting, one after the other; frame by frame another one begins. paths: the
/// same path at each size and with each number of samples. All chunks of a frame are loaded before it is
/// timed. Error as of drawing.
AccuracyResult measure_accuracy(std::span<const AccuracySubject> subjects,
                                std::span<const std::vector<FrameRequest>> paths,
                                const AccuracyOptions& options);

/// By how much a measured deviation may be above the pixel error: rounding of the measurement.
double tolerated_deviation(double pixel_error);

}  // namespace triptych
