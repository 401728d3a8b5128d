#include "nodes/frame_steering.hpp"

#include "base/clock.hpp"
#include "base/threads.hpp"

#include <algorithm>

namespace triptych {

const std::string& measure_name(CostMeasure measure) {
  static const std::string cpu = "cpu_over_threads", wall = "wall";
  return measure == CostMeasure::wall ? wall : cpu;
}

CostMeasure measure_of(const DeviceNames& device) {
  return kind_of(device) == DeviceKind::gl && is_graphics_card(device) ? CostMeasure::wall
                                                                       : CostMeasure::cpu_over_threads;
}

double cost_of(const SpentTime& spent, CostMeasure measure) {
  return measure == CostMeasure::wall ? spent.wall_ms : spent.cpu_ms / thread_count();
}

FrameSteering::FrameSteering(const Skeleton& skeleton, const SteeringOptions& options)
    : skeleton_(skeleton), options_(options), estimator_(skeleton), governor_(options.target_ms) {}

void FrameSteering::calibrate(LocalPipeline& pipeline, const FrameRequest& first) {
  constexpr double most_seconds = 2, most_targets = 2;
  const double asked = first.state.pixel_error;
  FrameRequest frame = first;
  frame.state.pixel_error = std::max(asked, max_raised_pixel_error);
  const Stopwatch stopwatch;
  double cost_ms = 0;
  for (bool last = false; !last && cost_ms <= most_targets * options_.target_ms;) {
    last = frame.state.pixel_error <= asked;
    for (int turn = 0; turn < 2 && stopwatch.seconds() < most_seconds; ++turn) {
      const SpentTime before = spent_time();
      const FrameWork work = estimator_.estimate(FrameView(skeleton_, frame.state, options_.rules), known_);
      known_ = pipeline.draw(frame).visible;
      cost_ms = cost_of(spent_time() - before, options_.measure);
      const FrameWork visible =
          estimator_.estimate(FrameView(skeleton_, frame.state, options_.rules), known_);
      model_.learn(at_least(work, visible), cost_ms);
      estimator_.loaded(known_);
    }
    frame.state.pixel_error = std::max(asked, frame.state.pixel_error / 2);
  }
  model_.end_calibration();
  pipeline.forget();
}

void FrameSteering::steer(FrameRequest& frame, double stretch) {
  if (unlearnt_) learn(*unlearnt_);
  unlearnt_.reset();
  const double asked = frame.state.pixel_error;
  const double aim_ms = governor_.aim_ms() / stretch;
  tried_.clear();
  const GovernedFrame governed = governor_.choose(asked, [&](double pixel_error) {
    frame.state.pixel_error = pixel_error;
    tried_.emplace_back(pixel_error,
                        estimator_.estimate(FrameView(skeleton_, frame.state, options_.rules), known_));
    return stretch * model_.predict(tried_.back().second);
  });
  frame.state.pixel_error = governed.pixel_error;
  const auto chosen = std::find_if(tried_.begin(), tried_.end(), [&](const auto& candidate) {
    return candidate.first == governed.pixel_error;
  });
  steered_.push_back({frame.number,
                      frame.state,
                      chosen->second,
                      {.target_ms = options_.target_ms,
                       .asked_pixel_error = asked,
                       .pixel_error = governed.pixel_error,
                       .aim_ms = aim_ms,
                       .predicted_ms = governed.predicted_ms / stretch,
                       .in_reach = governed.in_reach},
                      stretch});
}

/// The model learns what the work cost that was done: what the frame found besides was drawn, too, and says
/// nothing about the price of a triangle.
void FrameSteering::learn(const Steered& drawn) {
  const FrameWork visible = estimator_.estimate(FrameView(skeleton_, drawn.state, options_.rules), known_);
  model_.learn(at_least(drawn.work, visible), drawn.frame.cost_ms);
  governor_.learn(drawn.stretch * drawn.frame.predicted_ms, drawn.stretch * drawn.frame.cost_ms);
  estimator_.loaded(known_);
}

SteeredFrame FrameSteering::drawn(uint32_t number, const VisibleSet& visible, double cost_ms) {
  while (!steered_.empty() && steered_.front().number < number) steered_.pop_front();
  if (steered_.empty() || steered_.front().number != number) return {};
  unlearnt_ = std::move(steered_.front());
  steered_.pop_front();
  unlearnt_->frame.cost_ms = cost_ms;
  known_ = visible;
  return unlearnt_->frame;
}

}  // namespace triptych
