// What hiding objects and cutting the model open cost: the step itself, and the frames after it.
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

/// Of one set of hidden objects, or one section.
struct HidingCost {
  std::string hidden = "nothing", section = "none";
  size_t objects = 0;        ///< hidden
  size_t message_bytes = 0;  ///< of the message that tells a switch node
  CostTimes apply;           ///< from the set to scene nodes
  /// From the set or the section to its first picture, and that picture without either.
  CostTimes first_picture, same_picture;
  /// The first picture of the first round, which reads what had not been drawn before; clock, milliseconds.
  double cold_picture_ms = 0;
  CostTimes frame;                ///< of each frame of the path
  double cut = 0, triangles = 0;  ///< drawables of the cut, triangles drawn; means over the path
};

/// Of nothing, of one object and of every second one hidden, and of a plane through the middle of the model,
/// across its longest side, and of a box half as long as the model on each side, in turn, `rounds` times;
/// times of frames of the path are medians over rounds. Error (place: the pack) where there are no two
/// objects.
std::vector<HidingCost> measure_hiding(const Pack& pack, LocalPipeline& pipeline,
                                       const std::vector<FrameRequest>& frames, size_t rounds);

}  // namespace triptych
