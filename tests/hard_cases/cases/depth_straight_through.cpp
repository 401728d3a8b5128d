#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery depth_straight_through(
    {.name = "depth_straight_through",
     .group = "depth",
     .breaks =
         "The view direction is an axis, so whole walls lie at one depth and at grid points of the screen.",
     .faults = {},
     .make = [] {
       Trial trial;
       Maker maker;
       for (int z = 1; z <= 6; ++z) {
         for (int i = 0; i < 9; ++i)
           maker.box({i % 3 - 1.5, i / 3 - 1.5, -2 * z}, {i % 3 - 0.5, i / 3 - 0.5, -2 * z + 1});
       }
       trial.model = maker.model();
       trial.build.leaf_triangles = 12;
       for (int i = 0; i < 4; ++i)
         trial.views.push_back(look({0, 0, 4 * i}, {0, 0, -1}, 90, {64, 64}, 0.5, {0, 1, 0}));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
