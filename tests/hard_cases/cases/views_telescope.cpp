#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery views_telescope(
    {.name = "views_telescope",
     .group = "views",
     .breaks = "A field of view of a tenth of a degree makes pixels of rounding.",
     .faults = {},
     .make = [] {
       Trial trial;
       trial.thin = true;
       trial.model = small_house();
       for (int i = 0; i < 6; ++i)
         trial.views.push_back(look({-3000, 400.0 * i, 900}, {8, 4, 1.5}, 0.1, {}, 1));
       trial.views.push_back(look({1, 4, 1.5}, {12, 4, 1}, 0.1));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
