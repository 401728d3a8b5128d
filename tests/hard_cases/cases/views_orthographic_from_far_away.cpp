#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery views_orthographic_from_far_away(
    {.name = "views_orthographic_from_far_away",
     .group = "views",
     .breaks =
         "The eye of an orthographic view may stand anywhere along its axis; the picture must not care.",
     .faults = {},
     .make = [] {
       Trial trial;
       trial.model = small_house();
       trial.twin = std::make_shared<Trial>();
       trial.twin->model = trial.model;
       for (int i = 0; i < 6; ++i) {
         const glm::dvec3 target(8, 4, 1), from(0, 0, 1 << 5);
         const double height = 10 - i;
         trial.views.push_back(look_parallel(target + from * 0x1p25, target, height, {}, 0.01, {0, 1, 0}));
         trial.twin->views.push_back(look_parallel(target + from, target, height, {}, 0.01, {0, 1, 0}));
       }
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
