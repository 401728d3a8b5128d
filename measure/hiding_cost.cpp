#include "measure/hiding_cost.hpp"

#include "base/distribution.hpp"
#include "base/error.hpp"
#include "base/progress.hpp"
#include "base/spent_time.hpp"
#include "protocol/wire.hpp"
#include "scene/finest_boxes.hpp"

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

struct Step {
  std::string hidden, section;
  ObjectSet objects = {};
  Section cut = {};
};

/// The plane keeps what is beyond it.
Section through_the_middle(const Box& model) {
  const glm::dvec3 size = model.hi - model.lo;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  SectionPlane plane{.normal = glm::dvec3(0)};
  plane.normal[axis] = 1;
  plane.offset = center(model)[axis];
  Section section;
  section.add_plane(plane, "measure hiding");
  return section;
}

Section around_the_middle(const Box& model) {
  const glm::dvec3 middle = center(model), quarter = (model.hi - model.lo) / 4.0;
  Section section;
  section.set_box({middle - quarter, middle + quarter}, "measure hiding");
  return section;
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
    const Box model = model_box(pack_.skeleton());
    const std::vector<Step> steps = {{"nothing", "none"},
                                     {"one object", "none", {shown[shown.size() / 2]}},
                                     {"every second object", "none", every_second(shown)},
                                     {"nothing", "plane through the middle", {}, through_the_middle(model)},
                                     {"nothing", "box of half the sides", {}, around_the_middle(model)}};
    std::vector<HidingCost> costs(steps.size());
    std::vector<std::vector<CostTimes>> times(steps.size(), std::vector<CostTimes>(frames_.size()));
    Progress progress("rounds", rounds * steps.size());
    for (size_t round = 0; round < rounds; ++round) {
      for (size_t i = 0; i < steps.size(); ++i) {
        costs[i].hidden = steps[i].hidden;
        costs[i].section = steps[i].section;
        costs[i].objects = steps[i].objects.size();
        begin_in_the_middle(steps[i], costs[i]);
        if (round == 0) costs[i].cold_picture_ms = costs[i].first_picture.wall_ms.front();
        play(steps[i], costs[i], times[i]);
        progress.advance();
      }
    }
    for (size_t i = 0; i < steps.size(); ++i) {
      if (costs[i].objects > 0) costs[i].message_bytes = encode(HiddenSet{0, steps[i].objects}).size();
      for (const CostTimes& of_frame : times[i]) {
        costs[i].frame.wall_ms.push_back(distribution(of_frame.wall_ms).p50);
        costs[i].frame.cpu_ms.push_back(distribution(of_frame.cpu_ms).p50);
      }
    }
    return costs;
  }

 private:
  const FrameRecord& draw(FrameRequest frame, const Hiding& hiding, const Section& section) {
    frame.state.hiding = hiding;
    if (!section.keeps_all()) frame.state.section = section;
    return pipeline_.draw(frame);
  }
  Hiding applied(const Step& step) const {
    return hide(pack_.skeleton(), objects_, step.objects, "measure hiding");
  }

  /// A picture that rests, then one from which what the step takes away is gone.
  void begin_in_the_middle(const Step& step, HidingCost& cost) {
    const FrameRequest& frame = frames_[frames_.size() / 2];
    draw(frame, {}, {});
    draw(frame, {}, {});
    const StageWatch same;
    draw(frame, {}, {});
    add(cost.same_picture, same.spent());
    const StageWatch first;
    const Hiding hiding = applied(step);
    add(cost.apply, first.spent());
    draw(frame, hiding, step.cut);
    add(cost.first_picture, first.spent());
  }

  void play(const Step& step, HidingCost& cost, std::vector<CostTimes>& times) {
    const Hiding hiding = applied(step);
    pipeline_.forget();
    cost.cut = cost.triangles = 0;
    for (size_t i = 0; i < frames_.size(); ++i) {
      const StageWatch watch;
      const FrameRecord& record = draw(frames_[i], hiding, step.cut);
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
