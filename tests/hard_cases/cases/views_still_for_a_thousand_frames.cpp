#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery views_still_for_a_thousand_frames(
    {.name = "views_still_for_a_thousand_frames",
     .group = "views",
     .breaks = "A camera that stands still for a thousand frames: nothing may flicker, and the visible set "
               "must come to rest.",
     .faults = {"withheld-id", "flipped-byte"},
     .make = [] {
       Trial trial;
       trial.model = Maker().clutter(40, {-3, -3, -3}, {3, 3, 3}, 1, 12).model();
       trial.build.leaf_triangles = 12;
       trial.views.assign(1000, look({7, 3, 2}, {0, 0, 0}, 60, {32, 24}));
       trial.stands_still = true;
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
