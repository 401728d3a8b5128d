#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery views_wide_corners(
    {.name = "views_wide_corners",
     .group = "views",
     .breaks = "The corner of a wide view is far off the axis: the same deviation covers more pixels there.",
     .faults = {"dropped-stretch", "euclidean-depth"},
     .make = [] {
       Trial trial;
       Maker maker;
       for (int i = 0; i < 24; ++i)
         maker.mesh(awkward::sphere(12, 0.6),
                    awkward::translation({4.0 + (i % 3) * 9, 2.0 * (i / 3) - 8, 1.3 * (i % 5)}));
       trial.model = maker.model();
       for (int i = 0; i < 10; ++i)
         trial.views.push_back(look({-1.5 * i, 3.0 - i, 1}, {4.0 - 1.5 * i, 4, 1}, 120, {320, 240}));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
