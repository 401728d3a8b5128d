#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery views_below_a_degree(
    {.name = "views_below_a_degree",
     .group = "views",
     .breaks = "A tenth of a degree on a thousand rows: a pixel is finer than a float can say, and boxes "
               "still have to be tested.",
     .faults = {},
     .make = [] {
       Trial trial;
       trial.model = small_house();
       for (int i = 0; i < 6; ++i)
         trial.views.push_back(look({-300, 40.0 * i - 100, 90}, {8, 4, 1.5}, 0.1 + 0.15 * i, {48, 1080}, 1));
       trial.views.push_back(look({1, 2.5, 1.5}, {12, 4, 1}, 0.1, {48, 1080}));
       for (int i = 0; i < 3; ++i)
         trial.views.push_back(look_parallel({1, 2.5, 1.5}, {12, 4 + 0.5 * i, 1}, 0x1p-10, {48, 1080}));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
