#include "tests/hard_cases/states.hpp"

#include "base/clock.hpp"
#include "nodes/local_pipeline.hpp"
#include "scene/finest_boxes.hpp"
#include "tests/hard_cases/maker.hpp"
#include "tests/hard_cases/stress.hpp"
#include "tests/hard_cases/trials.hpp"
#include "tests/support/object_sets.hpp"
#include "tests/support/pictures.hpp"
#include "tests/support/test_device.hpp"
#include "visibility/frame_target.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace triptych::hard_cases {

namespace {

constexpr size_t states_of_a_scene = 100;

class RandomStates {
 public:
  RandomStates(const Trial& trial, const Pack& pack, uint32_t seed)
      : trial_(trial),
        pack_(pack),
        objects_(pack.read_objects()),
        model_(model_box(pack.skeleton())),
        random_(seed * 2654435761u + 1) {}

  FrameState next() {
    // A person hides and cuts more often than he jumps.
    if (random_.index(4) == 0) view_ = random_.index(trial_.views.size());
    if (random_.index(2) == 0) section_ = random_section();
    if (random_.index(2) == 0) {
      hidden_ = hide(pack_.skeleton(), objects_, test::random_set(random_, objects_.source().objects.size()),
                     "states");
    }
    FrameState state = trial_.state_of(view_);
    state.section = section_;
    state.hiding = hidden_;
    return state;
  }

 private:
  glm::dvec3 point() { return model_.lo + (model_.hi - model_.lo) * random_.vector(-0.2, 1.2); }

  Section random_section() {
    Section section;
    if (random_.index(3) == 0) return section;
    for (uint32_t count = random_.index(Section::max_planes + 1); count > 0; --count) {
      glm::dvec3 normal = random_.vector(-1, 1);
      if (random_.index(2) == 0) {  // as faces lie
        normal = glm::dvec3(0);
        normal[static_cast<int>(random_.index(3))] = random_.index(2) == 0 ? 1 : -1;
      }
      if (!(glm::length(normal) > 1e-3)) continue;
      normal = glm::normalize(normal);
      section.add_plane({normal, glm::dot(normal, point())}, "states");
    }
    if (random_.index(3) == 0) {
      const glm::dvec3 one = point(), other = point();
      const Box box{glm::min(one, other), glm::max(one, other)};
      if (glm::all(glm::lessThan(box.lo, box.hi))) section.set_box(box, "states");
    }
    return section;
  }

  const Trial& trial_;
  const Pack& pack_;
  const PackObjects objects_;
  const Box model_;
  Random random_;
  size_t view_ = 0;
  Section section_;
  Hiding hidden_;
};

/// How many of so many states fail.
size_t play(const Trial& trial, uint32_t seed, size_t count) {
  const BuiltTrial built(trial);
  const auto options = [&](StrategyKind cull) {
    return LocalPipelineOptions{.width = trial.views[0].width,
                                .height = trial.views[0].height,
                                .cull = cull,
                                .device = test::device()};
  };
  LocalPipelineOptions with_items = options(StrategyKind::frustum);
  with_items.item_buffer = true;
  LocalPipeline culled(built.pack(), options(StrategyKind::occlusion)),
      whole(built.pack(), options(StrategyKind::frustum)), items(built.pack(), with_items);
  RandomStates states(trial, built.pack(), seed);
  size_t failed = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const FrameRequest request{i, states.next()};
    const FrameRecord record = culled.draw(request);
    const std::vector<uint8_t> picture = culled.target().read_colors();
    whole.draw(request);
    const size_t pixels = test::differing_pixels(picture, whole.target().read_colors());
    items.draw(request);
    const size_t missing = difference(record.visible, owners(items.target().read_items())).added.size();
    if (pixels == 0 && missing == 0) continue;
    ++failed;
    fmt::print("seed {}, state {}: {} pixels differ, {} drawables that show are missing\n", seed, i, pixels,
               missing);
    std::fflush(stdout);
  }
  return failed;
}

}  // namespace

size_t run_states(size_t count, uint32_t first_seed) {
  const Stopwatch stopwatch;
  size_t done = 0, failed = 0;
  uint32_t seed = first_seed;
  for (; done < count; ++seed) {
    const size_t now = std::min(states_of_a_scene, count - done);
    done += now;
    Trial trial = random_trial(seed);
    trial.model = test::with_objects(std::move(trial.model));
    try {
      failed += play(trial, seed, now);
    } catch (const std::exception& error) {
      fmt::print("seed {}: {}\n", seed, error.what());
      failed += now;
    }
  }
  fmt::print("seeds {} to {}: {} states in {:.0f} s, {} failed\n", first_seed, seed - 1, done,
             stopwatch.seconds(), failed);
  return failed;
}

}  // namespace triptych::hard_cases
