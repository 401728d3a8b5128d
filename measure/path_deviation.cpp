#include "measure/path_deviation.hpp"

#include "base/error.hpp"
#include "base/signals.hpp"
#include "lod/cut.hpp"
#include "preprocess/check/check_distances.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace triptych {

namespace {

constexpr const char* stage = "deviation";

/// The drawables of the cuts along each path, ascending.
std::vector<std::vector<DrawableId>> drawables_along(const Skeleton& skeleton,
                                                     std::span<const std::vector<FrameRequest>> paths) {
  std::vector<std::vector<DrawableId>> all;
  CutLister cuts;
  for (const std::vector<FrameRequest>& frames : paths) {
    std::vector<uint8_t> used(skeleton.drawables.size(), 0);
    for (const FrameRequest& frame : frames) {
      for (const DrawableId id : cuts.list(FrameView(skeleton, frame.state))) used[id] = 1;
      end_if_asked(stage);
    }
    std::vector<DrawableId>& drawables = all.emplace_back();
    for (DrawableId id = 0; id < used.size(); ++id) {
      if (used[id]) drawables.push_back(id);
    }
  }
  return all;
}

/// For every drawable of the pack its measured distance; 0 where it is not in any of the lists.
std::vector<double> distances(const Pack& pack, const std::vector<std::vector<DrawableId>>& lists,
                              uint64_t points) {
  std::vector<DrawableId> wanted;
  for (const auto& list : lists) wanted.insert(wanted.end(), list.begin(), list.end());
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  const std::vector<double> measured = measured_distances(pack, wanted, points, [] { end_if_asked(stage); });
  std::vector<double> distances(pack.skeleton().drawables.size(), 0);
  for (size_t i = 0; i < wanted.size(); ++i) {
    if (std::isnan(measured[i]))
      fail(pack.name(), "drawable {} cannot be measured: a chunk is damaged", wanted[i]);
    distances[wanted[i]] = measured[i];
  }
  return distances;
}

void add_frame(PathDeviation& deviation, const Skeleton& skeleton, const FrameRequest& frame,
               const std::vector<double>& distances) {
  const FrameView view(skeleton, frame.state);
  for (const DrawableId id : select_cut(view).drawables) {
    if (distances[id] == 0) continue;  // however near the eye is
    const LatticeBox box = view.box(skeleton.drawables[id].scene_node);
    const double pixels =
        std::min(projected_error(view.focal_length, distances[id], view.eye_space.bounds(box)),
                 std::numeric_limits<double>::max());
    if (pixels <= deviation.pixels_max) continue;
    deviation.pixels_max = pixels;
    deviation.drawable = id;
    deviation.frame = frame.number;
  }
}

}  // namespace

std::vector<PathDeviation> measure_deviation(const Pack& pack,
                                             std::span<const std::vector<FrameRequest>> paths,
                                             uint64_t points) {
  const Skeleton& skeleton = pack.skeleton();
  const std::vector<std::vector<DrawableId>> lists = drawables_along(skeleton, paths);
  const std::vector<double> measured = distances(pack, lists, points);
  std::vector<PathDeviation> deviations;
  for (size_t path = 0; path < paths.size(); ++path) {
    PathDeviation& deviation = deviations.emplace_back();
    std::vector<double> ratios;
    for (const DrawableId id : lists[path]) {
      ++deviation.drawables;
      if (is_source(skeleton, id)) continue;
      ++deviation.drawables_simplified;
      if (measured[id] > skeleton.lattice().rounding())
        ratios.push_back(skeleton.drawables[id].error / measured[id]);
    }
    deviation.bound_over_measured = distribution(ratios);
    for (const FrameRequest& frame : paths[path]) {
      add_frame(deviation, skeleton, frame, measured);
      end_if_asked(stage);
    }
  }
  return deviations;
}

}  // namespace triptych
