#include "measure/json.hpp"
#include "measure/speed.hpp"

#include <algorithm>

namespace triptych {

namespace {

using Frame = SpeedSeries::Frame;

nlohmann::json stages_json(const std::vector<Frame>& frames) {
  nlohmann::json stages = nlohmann::json::object();
  for (size_t i = 0; i < frames.front().stages.size(); ++i) {
    stages[frames.front().stages[i].name] =
        distribution_json(frames, [i](const Frame& frame) { return frame.stages[i].milliseconds; });
  }
  return stages;
}

const SpeedSeries* find(const std::vector<SpeedSeries>& series, const std::string& method,
                        const std::string& device) {
  const auto found = std::find_if(series.begin(), series.end(), [&](const SpeedSeries& one) {
    return one.method == method && one.device == device && !one.frames.empty();
  });
  return found == series.end() ? nullptr : &*found;
}

/// Adds the median over the frames of one's value over the other's, where there are both.
template <typename Value>
void add_ratio(nlohmann::json& ratios, const std::string& name, const SpeedSeries* one,
               const SpeedSeries* other, Value value) {
  if (!one || !other) return;
  std::vector<double> pairs;
  for (size_t i = 0; i < std::min(one->frames.size(), other->frames.size()); ++i) {
    const double below = static_cast<double>(value(other->frames[i]));
    if (below > 0) pairs.push_back(static_cast<double>(value(one->frames[i])) / below);
  }
  if (!pairs.empty()) ratios[name] = distribution(pairs).p50;
}

}  // namespace

nlohmann::json speed_rows(const std::vector<SpeedSeries>& series) {
  nlohmann::json rows = nlohmann::json::array();
  for (const SpeedSeries& one : series) {
    nlohmann::json row = {{"method", one.method},
                          {"frame_ms", nullptr},
                          {"cpu_ms", nullptr},
                          {"drawn_triangles", nullptr},
                          {"stages_ms", nullptr}};
    if (!one.device.empty()) row["device"] = one.device;
    if (one.frames.empty()) {
      row["why"] = one.missing;
    } else {
      row["frame_ms"] = distribution_json(one.frames, [](const Frame& frame) { return frame.frame_ms; });
      row["cpu_ms"] = distribution_json(one.frames, [](const Frame& frame) { return frame.cpu_ms; });
      row["drawn_triangles"] =
          distribution_json(one.frames, [](const Frame& frame) { return frame.drawn_triangles; });
      row["stages_ms"] = stages_json(one.frames);
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

nlohmann::json speed_ratios(const std::vector<SpeedSeries>& series, const std::string& device) {
  const auto milliseconds = [](const Frame& frame) { return frame.frame_ms; };
  const auto triangles = [](const Frame& frame) { return frame.drawn_triangles; };
  const SpeedSeries* const triptych = find(series, "triptych", device);
  const SpeedSeries* const oracle = find(series, "oracle", device);
  nlohmann::json ratios = nlohmann::json::object();
  add_ratio(ratios, "triptych_over_embree", triptych, find(series, "embree", ""), milliseconds);
  add_ratio(ratios, "triptych_over_oracle", triptych, oracle, milliseconds);
  add_ratio(ratios, "triptych_over_frustum", triptych, find(series, "frustum", device), milliseconds);
  add_ratio(ratios, "triptych_over_frustum_hidepth", triptych, find(series, "frustum-hidepth", device),
            milliseconds);
  add_ratio(ratios, "everything_over_triptych", find(series, "everything", "gl"), triptych, milliseconds);
  add_ratio(ratios, "gl_over_cpu", find(series, "triptych", "gl"), find(series, "triptych", "cpu"),
            milliseconds);
  add_ratio(ratios, "triptych_triangles_over_oracle", triptych, oracle, triangles);
  if (triptych) {
    std::vector<double> times;
    for (const Frame& frame : triptych->frames) times.push_back(frame.frame_ms);
    const Distribution spread = distribution(times);
    ratios["p95_over_median"] = spread.p95 / spread.p50;
  }
  return ratios;
}

}  // namespace triptych
