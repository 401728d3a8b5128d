#include "measure/prediction_trial.hpp"

#include "measure/json.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

namespace triptych {

namespace {

using nlohmann::json;

double median(std::vector<double> values) { return distribution(values).p50; }

double off_by(double value, double truth) { return truth > 0 ? std::abs(value / truth - 1) : 0; }

/// {"mean", …, "share_within_10_percent"}; null where there is no value.
json errors_json(const std::vector<double>& errors) {
  constexpr double goal = 0.1;
  if (errors.empty()) return nullptr;
  json result = to_json(distribution(errors));
  const auto within = std::count_if(errors.begin(), errors.end(), [](double error) { return error <= goal; });
  result["share_within_10_percent"] = static_cast<double>(within) / static_cast<double>(errors.size());
  return result;
}

std::string text(const json& errors) {
  if (errors.is_null()) return "none";
  return fmt::format("{:.0f} % in the median, {:.0f} % in the 95th percentile",
                     100 * errors["p50"].get<double>(), 100 * errors["p95"].get<double>());
}

json series(const std::vector<TriedFrame>& frames, const auto& value) {
  json values = json::array();
  for (const TriedFrame& frame : frames) values.push_back(std::round(value(frame) * 1000) / 1000);
  return values;
}

}  // namespace

double TriedFrame::settled_ms() const { return steering_ms + median(again_ms); }

std::vector<TriedFrame> try_predictions(LocalPipeline& pipeline, FrameSteering& steering,
                                        std::vector<FrameRequest>& frames, size_t repetitions) {
  const CostMeasure measure = steering.options().measure;
  if (!frames.empty()) steering.calibrate(pipeline, frames.front());
  VisibleSet before;
  std::vector<TriedFrame> tried;
  for (FrameRequest& frame : frames) {
    TriedFrame& now = tried.emplace_back();
    const SpentTime began = spent_time();
    steering.steer(frame);
    now.steering_ms = cost_of(spent_time() - began, measure);
    const VisibleSet visible = pipeline.draw(frame).visible;
    now.steered = steering.drawn(frame.number, visible, cost_of(spent_time() - began, measure));
    now.work = steering.work_of_drawn();
    for (size_t i = 0; i < repetitions; ++i) {
      pipeline.resume(before);
      const SpentTime again = spent_time();
      pipeline.draw(frame);
      now.again_ms.push_back(cost_of(spent_time() - again, measure));
    }
    before = visible;
  }
  return tried;
}

std::string add_predictions(json& report, const std::vector<TriedFrame>& frames) {
  std::vector<double> once, settled, noise, of_loading, of_relevant, relevant_noise;
  for (const TriedFrame& frame : frames) {
    const double error = off_by(frame.steered.predicted_ms, frame.steered.cost_ms);
    if (frame.loads()) {
      of_loading.push_back(error);
      continue;
    }
    once.push_back(error);
    settled.push_back(off_by(frame.steered.predicted_ms, frame.settled_ms()));
    noise.push_back(off_by(frame.steered.cost_ms, frame.settled_ms()));
    if (!frame.is_relevant()) continue;
    of_relevant.push_back(settled.back());
    relevant_noise.push_back(noise.back());
  }
  report["frames"] = frames.size();
  report["loading_frames"] = of_loading.size();
  report["prediction_error"] = {{"of_one_drawing", errors_json(once)},
                                {"of_the_median", errors_json(settled)},
                                {"of_relevant_frames", errors_json(of_relevant)},
                                {"of_loading_frames", errors_json(of_loading)}};
  report["noise"] = errors_json(noise);
  report["noise_of_relevant_frames"] = errors_json(relevant_noise);
  report["relevant_frames"] = of_relevant.size();
  json work = json::object();
  for (size_t term = 0; term < FrameWork::terms; ++term) {
    json& values = work[FrameWork::names()[term]] = json::array();
    for (const TriedFrame& frame : frames) values.push_back(frame.work.values()[term]);
  }
  report["series"] = {
      {"predicted_ms", series(frames, [](const TriedFrame& f) { return f.steered.predicted_ms; })},
      {"cost_ms", series(frames, [](const TriedFrame& f) { return f.steered.cost_ms; })},
      {"settled_ms", series(frames, [](const TriedFrame& f) { return f.settled_ms(); })},
      {"pixel_error", series(frames, [](const TriedFrame& f) { return f.steered.pixel_error; })},
      {"work", work}};
  const json& errors = std::as_const(report)["prediction_error"];
  return fmt::format(
      "{} frames that read nothing: predictions are off by {} of the median of several drawings; {} of one "
      "drawing, which is itself off by {} of that median\n{} of them that take at least {:g} of the target: "
      "predictions are off by {} of that median, one drawing by {}\n{} frames that read chunks: off by {}\n",
      once.size(), text(errors["of_the_median"]), text(errors["of_one_drawing"]), text(report["noise"]),
      of_relevant.size(), TriedFrame::relevant_share, text(errors["of_relevant_frames"]),
      text(report["noise_of_relevant_frames"]), of_loading.size(), text(errors["of_loading_frames"]));
}

}  // namespace triptych
