#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery views_oscillating(
    {.name = "views_oscillating",
     .group = "views",
     .breaks =
         "Between two places, back and forth: each frame the representation is that of the other place.",
     .faults = {"stale-camera", "carried-hidden"},
     .make = [] {
       Trial trial;
       trial.model = small_house();
       for (int i = 0; i < 8; ++i) {
         trial.views.push_back(look({1, 2.5, 1.5}, {12, 4, 1.25}));
         trial.views.push_back(look({9.5, 4, 1.5}, {15, 6, 1}));
       }
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
