#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery boxes_cut_by_the_near_plane(
    {.name = "boxes_cut_by_the_near_plane",
     .group = "boxes",
     .breaks = "A box that the near plane cuts has no projection: the corners behind it come out on the "
               "wrong side.",
     .faults = {"no-near-rule"},
     .make = [] {
       Trial trial;
       trial.model = Maker()
                         .box({-20, -20, -1}, {20, 20, -0.8})
                         .box({-1, 3, -1.5}, {1, 3.5, 2})
                         .box({-20, 8, -1}, {20, 9, 3})
                         .clutter(40, {-6, -6, -6}, {6, 6, 6}, 0.5, 3)
                         .model();
       trial.build.leaf_triangles = 12;
       for (int i = 0; i < 10; ++i)
         trial.views.push_back(look({0.05 * i, -1, 0.2}, {0, 3, 0}, 80, {}, 0.5 + 0.2 * i));
       for (int i = 0; i < 10; ++i)
         trial.views.push_back(look({-8 + 1.7 * i, -3, 1.5}, {-4 + 1.7 * i, 2, 0}, 80, {}, 0.5 + 0.2 * i));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
