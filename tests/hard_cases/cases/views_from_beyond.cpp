#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery views_from_beyond(
    {.name = "views_from_beyond",
     .group = "views",
     .breaks = "From 1e200 units away, and at 1e200 units beside it, a model is nothing, and no square of a "
               "distance is finite.",
     .faults = {},
     .make = [] {
       Trial trial;
       trial.model = small_house();
       trial.may_be_empty = true;
       for (const double far : {1e30, 1e100, 1e200, 1e300}) {
         trial.views.push_back(look({far, far, far}, {0, 0, 0}));
         trial.views.push_back(look({1, 2.5, 1.5}, {far, 0.1 * far, 0}));
         trial.views.push_back(look_parallel({far, far, far}, {0, 0, 0}, far));
         trial.views.push_back(look_parallel({-far, 2.5, 1.5}, {0, 2.5, 1.5}, 3));
       }
       for (const double near : {1e-300, 1e-30, 1e30, 1e300})
         trial.views.push_back(look({1, 2.5, 1.5}, {12, 4, 1.25}, 60, {}, near));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
