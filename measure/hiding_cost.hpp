// What hiding objects costs: the step itself, and the frames after it.
#pragma once

#include "nodes/local_pipeline.hpp"
#include "scene/hidden_objects.hpp"
#include "scene/pack.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace triptych {

/// One time each for each time that something was done, milliseconds: by the clock, and of processors over
/// all threads, which other programs disturb little.
struct CostTimes {
  std::vector<double> wall_ms, cpu_ms;
};

/// Of one set of hidden objects.
struct HidingCost {
  std::string what;
  size_t objects = 0;        ///< hidden
  size_t message_bytes = 0;  ///< of the message that tells a switch node
  CostTimes apply;           ///< from the set to scene nodes
  /// From the set to its first picture, and that picture without anything hidden.
  CostTimes first_picture, same_picture;
  CostTimes frame;                ///< of each frame of the path
  double cut = 0, triangles = 0;  ///< drawables of the cut, triangles drawn; means over the path
};

/// Of nothing, of one object, and of every second one, in turn, `rounds` times; times of frames of the path
/// are medians over rounds. Error (place: the pack) where there are no two objects.
std::vector<HidingCost> measure_hiding(const Pack& pack, LocalPipeline& pipeline,
                                       const std::vector<FrameRequest>& frames, size_t rounds);

}  // namespace triptych
