#include "measure/hiding_cost.hpp"

#include "base/distribution.hpp"
#include "base/error.hpp"
#include "base/progress.hpp"
#include "base/spent_time.hpp"
#include "protocol/wire.hpp"

#include <utility>

namespace triptych {

namespace {

/// Objects that something shows.
ObjectSet shown_objects(const PackObjects& objects) {
  ObjectSet shown;
  for (SourceObjectId id = 0; id < objects.source().objects.size(); ++id) {
    if (!objects.nodes_of(id).empty()) shown.push_back(id);
  }
  return shown;
}

ObjectSet every_second(const ObjectSet& objects) {
  ObjectSet found;
  for (size_t i = 0; i < objects.size(); i += 2) found.push_back(objects[i]);
  return found;
}

void add(CostTimes& times, const SpentTime& spent) {
  times.wall_ms.push_back(spent.wall_ms);
  times.cpu_ms.push_back(spent.cpu_ms);
}

class HidingTrial {
 public:
  HidingTrial(const Pack& pack, LocalPipeline& pipeline, const std::vector<FrameRequest>& frames)
      : pack_(pack), objects_(pack.read_objects()), pipeline_(pipeline), frames_(frames) {}

  std::vector<HidingCost> run(size_t rounds) {
    const ObjectSet shown = shown_objects(objects_);
    if (shown.size() < 2) fail(pack_.name(), "there are no two objects in it, one to hide and one to show");
    const std::vector<std::pair<std::string, ObjectSet>> sets = {
        {"nothing", {}},
        {"one object", {shown[shown.size() / 2]}},
        {"every second object", every_second(shown)}};
    std::vector<HidingCost> costs(sets.size());
    std::vector<std::vector<CostTimes>> times(sets.size(), std::vector<CostTimes>(frames_.size()));
    Progress progress("rounds", rounds * sets.size());
    for (size_t round = 0; round < rounds; ++round) {
      for (size_t i = 0; i < sets.size(); ++i) {
        costs[i].what = sets[i].first;
        costs[i].objects = sets[i].second.size();
        hide_in_the_middle(sets[i].second, costs[i]);
        play(hide(pack_.skeleton(), objects_, sets[i].second, "measure hiding"), costs[i], times[i]);
        progress.advance();
      }
    }
    for (size_t i = 0; i < sets.size(); ++i) {
      if (costs[i].objects > 0) costs[i].message_bytes = encode(HiddenSet{0, sets[i].second}).size();
      for (const CostTimes& of_frame : times[i]) {
        costs[i].frame.wall_ms.push_back(distribution(of_frame.wall_ms).p50);
        costs[i].frame.cpu_ms.push_back(distribution(of_frame.cpu_ms).p50);
      }
    }
    return costs;
  }

 private:
  const FrameRecord& draw(FrameRequest frame, const Hiding& hiding) {
    frame.state.hiding = hiding;
    return pipeline_.draw(frame);
  }

  /// A picture that rests, then one from which the objects are gone.
  void hide_in_the_middle(const ObjectSet& set, HidingCost& cost) {
    const FrameRequest& frame = frames_[frames_.size() / 2];
    draw(frame, {});
    draw(frame, {});
    const StageWatch same;
    draw(frame, {});
    add(cost.same_picture, same.spent());
    const StageWatch first;
    const Hiding hiding = hide(pack_.skeleton(), objects_, set, "measure hiding");
    add(cost.apply, first.spent());
    draw(frame, hiding);
    add(cost.first_picture, first.spent());
  }

  void play(const Hiding& hiding, HidingCost& cost, std::vector<CostTimes>& times) {
    pipeline_.forget();
    cost.cut = cost.triangles = 0;
    for (size_t i = 0; i < frames_.size(); ++i) {
      const StageWatch watch;
      const FrameRecord& record = draw(frames_[i], hiding);
      add(times[i], watch.spent());
      cost.cut += static_cast<double>(record.cut_drawables) / static_cast<double>(frames_.size());
      cost.triangles += static_cast<double>(record.drawn_triangles) / static_cast<double>(frames_.size());
    }
  }

  const Pack& pack_;
  const PackObjects objects_;
  LocalPipeline& pipeline_;
  const std::vector<FrameRequest>& frames_;
};

}  // namespace

std::vector<HidingCost> measure_hiding(const Pack& pack, LocalPipeline& pipeline,
                                       const std::vector<FrameRequest>& frames, size_t rounds) {
  return HidingTrial(pack, pipeline, frames).run(rounds);
}

}  // namespace triptych
