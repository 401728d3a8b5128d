#include "measure/steering_report.hpp"

#include "base/threads.hpp"
#include "measure/json.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

namespace triptych {

namespace {

using nlohmann::json;
using Frames = std::vector<SteeredFrame>;

/// The share of the frames with at most 1.2 times the target; null where there is no frame.
template <typename Value>
json share_within(const Frames& frames, double target_ms, Value value) {
  if (frames.empty()) return nullptr;
  const auto within = std::count_if(frames.begin(), frames.end(), [&](const SteeredFrame& frame) {
    return value(frame) <= target_tolerance * target_ms;
  });
  return static_cast<double>(within) / static_cast<double>(frames.size());
}

/// To the microsecond, as other series are.
template <typename Value>
json series(const Frames& frames, Value value) {
  json values = json::array();
  for (const SteeredFrame& frame : frames) values.push_back(std::round(value(frame) * 1000) / 1000);
  return values;
}

std::string percent(const json& share) {
  return share.is_null() ? "none" : fmt::format("{:.1f} %", 100 * share.get<double>());
}

/// Of a machine that others share, often nothing can be said.
std::string wall_text(const json& share, size_t undisturbed) {
  if (share.is_null()) return "no frame was undisturbed";
  return fmt::format("in wall time {} of the {} undisturbed ones", percent(share), undisturbed);
}

}  // namespace

json coefficients_json(const CostCoefficients& coefficients) {
  json named = json::object();
  for (size_t i = 0; i < coefficients.size(); ++i) named[FrameWork::names()[i]] = coefficients[i];
  return named;
}

std::string add_steering(json& report, const std::vector<FrameRecord>& records, double target_ms,
                         const std::string& measure, const CostCoefficients& coefficients) {
  Frames frames, undisturbed;
  for (const FrameRecord& record : records) {
    if (record.steered.target_ms <= 0) continue;
    frames.push_back(record.steered);
    if (record.steered.undisturbed) undisturbed.push_back(record.steered);
  }
  const auto cost = [](const SteeredFrame& frame) { return frame.cost_ms; };
  const auto aim = [](const SteeredFrame& frame) { return frame.aim_ms; };
  const auto wall = [](const SteeredFrame& frame) { return frame.wall_ms; };
  const auto pixel_error = [](const SteeredFrame& frame) { return frame.pixel_error; };
  const auto count = [&](auto predicate) { return std::count_if(frames.begin(), frames.end(), predicate); };
  const json within = share_within(frames, target_ms, cost),
             wall_within = share_within(undisturbed, target_ms, wall);
  const auto raised =
      count([](const SteeredFrame& frame) { return frame.pixel_error > frame.asked_pixel_error; });
  const auto out_of_reach = count([](const SteeredFrame& frame) { return !frame.in_reach; });
  const json errors = distribution_json(frames, [](const SteeredFrame& frame) {
    return frame.cost_ms > 0 ? std::abs(frame.predicted_ms / frame.cost_ms - 1) : 0;
  });
  report["target_ms"] = target_ms;
  report["pixel_error"] = distribution_json(frames, pixel_error);
  report["steering"] = {{"cost", measure},
                        {"threads", thread_count()},
                        {"aim_ms", distribution_json(frames, aim)},
                        {"cost_ms", distribution_json(frames, cost)},
                        {"wall_ms", distribution_json(frames, wall)},
                        {"share_within", within},
                        {"share_within_undisturbed_wall", wall_within},
                        {"undisturbed_frames", undisturbed.size()},
                        {"raised_frames", raised},
                        {"out_of_reach_frames", out_of_reach},
                        {"max_pixel_error", max_raised_pixel_error},
                        {"prediction_error", errors},
                        {"coefficients_ms", coefficients_json(coefficients)}};
  report["series"]["pixel_error"] = series(frames, pixel_error);
  report["series"]["aim_ms"] = series(frames, aim);
  report["series"]["cost_ms"] = series(frames, cost);
  report["series"]["predicted_ms"] =
      series(frames, [](const SteeredFrame& frame) { return frame.predicted_ms; });
  std::string line = fmt::format(
      "target {:g} ms: {} of the frames cost at most {:g} ms ({}), {}; pixel error raised in {} of {}, to "
      "{:.1f} in the median and {:.1f} at most; predictions off by {:.0f} % in the median, {:.0f} % in the "
      "95th percentile",
      target_ms, percent(within), target_tolerance * target_ms, measure,
      wall_text(wall_within, undisturbed.size()), raised, frames.size(),
      report["pixel_error"]["p50"].get<double>(), report["pixel_error"]["max"].get<double>(),
      100 * errors["p50"].get<double>(), 100 * errors["p95"].get<double>());
  if (out_of_reach > 0) {
    line += fmt::format("; {} would take longer at {:g} pixels, too: they need more time or a smaller --size",
                        out_of_reach, max_raised_pixel_error);
  }
  return line + "\n";
}

std::string add_steering(json& report, const std::vector<FrameRecord>& frames,
                         const FrameSteering& steering) {
  return add_steering(report, frames, steering.options().target_ms, measure_name(steering.options().measure),
                      steering.model().coefficients());
}

}  // namespace triptych
