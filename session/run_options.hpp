// Options of every process that draws a pack along a path.
#pragma once

#include "nodes/device_choice.hpp"
#include "scene/frame_state.hpp"
#include "scene/pack.hpp"
#include "visibility/hardware_cull.hpp"

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace triptych {

/// The most frames, or repetitions of a path, of a command.
constexpr uint64_t max_frames = std::numeric_limits<uint32_t>::max();

/// Pixels.
struct PictureSize {
  int width = 512, height = 512;
};

struct RunOptions {
  std::filesystem::path pack, path, json;
  PictureSize size;
  std::vector<double> pixel_errors = {1};  ///< a list where a command sweeps
  uint32_t samples = 1;                    ///< a pixel
  bool edges = false;                      ///< drawn as lines
  Effects effects = Effects::all();        ///< that are drawn where the model calls for them
  double time = 0;                         ///< seconds, of frames whose path names no time
  std::vector<std::string> hide, isolate;  ///< words that mean objects (scene/object_words.hpp)
  Section section = {};                    ///< what is shown of the model
  std::optional<double> moment = {};       ///< of the sky (scene/sun.hpp); nothing: it is not shown
  double target_ms = 0;  ///< pixel errors are raised so that frames take no longer; 0: they are not
  DeviceOptions device{.kind = DeviceKind::automatic};
  size_t frames = 0;   ///< only the first ones; 0: all
  uint32_t every = 1;  ///< of those, only every so many, from the first one on
  double pixel_error() const { return pixel_errors.front(); }
};

/// Says, of a program that was built without effects, which of those that the pack calls for it leaves out.
void say_effects_left_out(const RunOptions& options, const Skeleton& skeleton);

/// The sky at the options' moment, over the model's place. Error where the pack does not say the place.
Sky sky_of(const RunOptions& options, const Skeleton& skeleton);

/// What the options hide: all but what is isolated, and what is hidden, each with all that is in it. Error
/// for a word that means nothing.
Hiding load_hiding(const RunOptions& options, const Pack& pack);

/// The frames that the options ask for, in order. Error for a path that cannot be used, and as
/// load_hiding().
std::vector<FrameRequest> load_frames(const RunOptions& options, const Pack& pack);
/// The same of a command that hides nothing.
std::vector<FrameRequest> load_frames(const RunOptions& options, const Skeleton& skeleton);

}  // namespace triptych
