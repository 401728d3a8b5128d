#include "report/goals.hpp"

#include <cmath>
#include <fmt/core.h>

namespace triptych {

std::string Goal::verdict() const {
  const std::string against =
      fmt::format("{:.{}f}, {} {:.{}f}", value, decimals, at_least ? "at least" : "at most", limit, decimals);
  if (!held) {
    return fmt::format("not held to: {:.{}f} ({} {:.{}f})", value, decimals,
                       at_least ? "at least" : "at most", limit, decimals);
  }
  if (met()) return "met: " + against;
  // A goal that is missed by less than the last decimal must not be printed as missed by 0.
  const double by = std::abs(value - limit);
  const int digits = by > 0 && by < std::pow(10, -decimals) ? decimals + 4 : decimals;
  return fmt::format("missed by {:.{}f}: {}", by, digits, against);
}

namespace {

double ratio(double over, double under) { return under > 0 ? over / under : over > 0 ? INFINITY : 0; }

void judge_exactness(const ReportEntry& run, const std::string& path, std::vector<Goal>& targets) {
  const double frames = run.figure("/frames");
  targets.push_back({"frames of the " + path + " compared, three processes",
                     run.figure("/frames_compared"),
                     frames,
                     true,
                     0,
                     {run.name}});
  targets.push_back({"frames of the " + path + " identical to the un-culled picture, three processes",
                     run.figure("/identical_frames"),
                     frames,
                     true,
                     0,
                     {run.name}});
  targets.push_back({"frames of the " + path + " identical to the un-culled picture, one process",
                     run.figure("/one_process/identical_frames"),
                     frames,
                     true,
                     0,
                     {run.name}});
  targets.push_back(
      {"digest mismatches on the " + path, run.figure("/digest_mismatches"), 0, false, 0, {run.name}});
}

}  // namespace

std::vector<Goal> judge(const Report& report) {
  std::vector<Goal> targets;
  size_t exactness = 0;  // how many of them, at the beginning
  const ReportEntry* const walk = report.find("walk");
  const ReportEntry* const one = report.find("one_process");
  const ReportEntry* const full = report.find("full_detail");
  const ReportEntry* const coarse = report.find("coarse");
  if (walk) {
    judge_exactness(*walk, "walk", targets);
    exactness = targets.size();
    targets.push_back({"culling efficiency on the walk: drawables drawn for each one visible",
                       walk->figure("/culling_efficiency"),
                       3,
                       false,
                       2,
                       {"walk"}});
    targets.push_back({"ids that deltas save on the walk, in %",
                       walk->figure("/delta/saved_percent"),
                       93,
                       true,
                       1,
                       {"walk"}});
    targets.push_back({"bytes of delta bodies for each id that changes on the walk",
                       walk->figure("/delta/body_bytes_per_id"),
                       1.7,
                       false,
                       2,
                       {"walk"}});
    targets.push_back(
        {"all traffic on the walk, as a share of the paper's formula at 4 bytes for each visible id",
         walk->figure("/traffic/share_of_formula_whole_sets"),
         0.45,
         false,
         3,
         {"walk"}});
  }
  if (one && coarse) {
    targets.push_back({"triangles drawn at 8 pixels of error, as a share of those at 1",
                       ratio(coarse->figure("/drawn_triangles/mean"), one->figure("/drawn_triangles/mean")),
                       0.5,
                       false,
                       3,
                       {"coarse", "one_process"}});
  }
  if (one && full) {
    targets.push_back({"median frame in one process, as a share of the frustum at full detail",
                       ratio(one->figure("/frame_ms/p50"), full->figure("/frame_ms/p50")),
                       0.1,
                       false,
                       3,
                       {"one_process", "full_detail"}});
  }
  for (size_t i = exactness; i < targets.size(); ++i) targets[i].held = !report.held_to_exactness_alone;
  return targets;
}

}  // namespace triptych
