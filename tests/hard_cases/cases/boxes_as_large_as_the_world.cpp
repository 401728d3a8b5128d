#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery boxes_as_large_as_the_world(
    {.name = "boxes_as_large_as_the_world",
     .group = "boxes",
     .breaks = "One object surrounds all others: its box is in front of everything, wherever the eye is.",
     .faults = {},
     .make = [] {
       Trial trial;
       trial.model = scenes::make("world");
       trial.views = around({0, 0, 0}, 7, 6);
       trial.views.push_back(look({0, 0, 0}, {1, 1, 0}));
       trial.views.push_back(look({25, 0, 5}, {0, 0, 0}));
       trial.views.push_back(look({8, 0, 1}, {0, 0, 0}, 90));
       trial.pixel_error = 4;
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
