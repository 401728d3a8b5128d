// How well frames' costs are predicted, beside how well they can be: each frame is drawn several times.
#pragma once

#include "nodes/frame_steering.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace triptych {

/// A frame that was steered and drawn, and then drawn again from the same V(i−1). Costs are in the measure of
/// the steering, of drawing alone in again_ms, with the steering in `steered`.
struct TriedFrame {
  SteeredFrame steered;
  FrameWork work;                ///< as it was estimated
  double steering_ms = 0;        ///< of steered.cost_ms, what choosing the pixel error cost
  std::vector<double> again_ms;  ///< chunks are in memory by then

  bool loads() const { return work.new_triangles > 0; }
  /// Steering, and the median of the repetitions: what the frame costs, noise aside.
  double settled_ms() const;
  /// Whether that is so much of the target that it matters what is predicted.
  bool is_relevant() const { return settled_ms() >= relevant_share * steered.target_ms; }
  static constexpr double relevant_share = 0.5;
};

/// Draws the frames in order, each `repetitions` times more, at least 2. The pipeline and its frames are of
/// one size.
std::vector<TriedFrame> try_predictions(LocalPipeline& pipeline, FrameSteering& steering,
                                        std::vector<FrameRequest>& frames, size_t repetitions);

/// Adds the keys of docs/using.md for `measure target`. Returns a summary of a few lines, for people.
std::string add_predictions(nlohmann::json& report, const std::vector<TriedFrame>& frames);

}  // namespace triptych
