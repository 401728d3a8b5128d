#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery views_of_both_kinds(
    {.name = "views_of_both_kinds",
     .group = "views",
     .breaks = "Perspective and parallel views in turn: nothing of the last frame, neither its depths nor "
               "its visible set, fits the next.",
     .faults = {"stale-camera", "carried-hidden"},
     .make = [] {
       Trial trial;
       trial.model = small_house();
       for (int i = 0; i < 10; ++i) {
         const glm::dvec3 eye(1 + 0.4 * i, 2.5, 1.5), target(12, 4, 1.25);
         trial.views.push_back(i % 2 == 0 ? look(eye, target) : look_parallel(eye, target, 3));
       }
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
