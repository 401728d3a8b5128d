// What hiding objects costs: the step itself, and the frames after it.
#pragma once

#include "nodes/local_pipeline.hpp"
#include "scene/hidden_objects.hpp"
#include "scene/pack.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace triptych {

/// Of one set of hidden objects.
struct HidingCost {
  std::string what;
  size_t objects = 0;            ///< hidden
  size_t message_bytes = 0;      ///< of the message that tells a switch node
  std::vector<double> apply_ms;  ///< from the set to scene nodes, each time
  /// From the set to its first picture, each time, and that picture without anything hidden.
  std::vector<double> first_picture_ms, same_picture_ms;
  std::vector<double> frame_ms;   ///< of each frame of the path
  double cut = 0, triangles = 0;  ///< drawables of the cut, triangles drawn; means over the path
};

/// Of nothing, of one object, and of every second one, in turn, `rounds` times; times of frames are medians
/// over rounds. Error (place: the pack) where there are no two objects.
std::vector<HidingCost> measure_hiding(const Pack& pack, LocalPipeline& pipeline,
                                       const std::vector<FrameRequest>& frames, size_t rounds);

}  // namespace triptych
