#include "tests/hard_cases/maker.hpp"

#include <cmath>

namespace triptych::hard_cases {
namespace {

const InGallery views_rolls(
    {.name = "views_rolls",
     .group = "views",
     .breaks = "Only the up vector turns: corners of the picture sweep over what was outside.",
     .faults = {"stale-camera"},
     .make = [] {
       Trial trial;
       trial.model = small_house();
       for (int i = 0; i < 12; ++i) {
         const double angle = 0.55 * i;
         trial.views.push_back(
             look({1, 2.5, 1.5}, {12, 4, 1.25}, 60, {120, 40}, 0.01, {0, std::sin(angle), std::cos(angle)}));
       }
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
