#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery boxes_behind_the_eye(
    {.name = "boxes_behind_the_eye",
     .group = "boxes",
     .breaks = "Most of the scene is behind the eye, some of it straddles the plane of the eye: mirrored by "
               "a division, it would hide what is in front.",
     .faults = {"no-near-rule"},
     .make = [] {
       Trial trial;
       trial.model = Maker()
                         .box({-30, -3, -3}, {30, -2.5, 3})
                         .box({-30, 2.5, -3}, {30, 3, 3})
                         .box({-30, -1, -3}, {30, 1, -2.8})
                         .box({8, -2.4, -2.6}, {8.5, 2.4, 2.6})
                         .clutter(40, {-20, -2, -2}, {6, 2, 2}, 0.3, 5)
                         .model();
       trial.build.leaf_triangles = 12;
       for (int i = 0; i < 8; ++i)
         trial.views.push_back(look({0.2 * i - 0.4, 0, 0}, {3, 0.05 * i - 0.2, 0}, 100));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
