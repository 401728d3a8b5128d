#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery occlusion_that_goes_in_one_frame(
    {.name = "occlusion_that_goes_in_one_frame",
     .group = "occlusion",
     .breaks = "The eye steps through a wall: what hid everything is behind it from one frame to the next.",
     .faults = {"carried-hidden", "stale-camera"},
     .make = [] {
       Trial trial;
       trial.model = small_house();
       for (int i = 0; i < 12; ++i) trial.views.push_back(look({11.2 + 0.2 * i, 4, 1.5}, {15.5, 4, 1.4}, 90));
       for (int i = 0; i < 6; ++i)
         trial.views.push_back(look({i % 2 ? 11.9 : 12.3, 5, 1.5}, {15.5, 4, 1.4}, 90));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
