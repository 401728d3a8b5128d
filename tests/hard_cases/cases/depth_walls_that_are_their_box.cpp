#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery depth_walls_that_are_their_box(
    {.name = "depth_walls_that_are_their_box",
     .group = "depth",
     .breaks = "A wall seen straight on is its own bounding box: its test is decided by the last bit.",
     .faults = {},
     .make = [] {
       Trial trial;
       Maker maker;
       for (int i = 0; i < 36; ++i)
         maker.quad({2.0 * (i % 6), 0.5 * (i % 5), 2.0 * (i / 6)}, {1.8, 0, 0}, {0, 0, 1.8});
       trial.model = maker.model();
       trial.build.leaf_triangles = 2;
       for (int i = 0; i < 8; ++i) trial.views.push_back(look({6, -8 - i, 6}, {6, 0, 6}));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
