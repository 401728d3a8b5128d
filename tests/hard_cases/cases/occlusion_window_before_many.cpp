#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery occlusion_window_before_many(
    {.name = "occlusion_window_before_many",
     .group = "occlusion",
     .breaks = "A wall with one window in front of a million triangles.",
     .faults = {"withheld-id", "carried-hidden"},
     .make = [] {
       Trial trial;
       Maker maker;
       maker.box({-20, 0, 0}, {-1, 0.2, 10})
           .box({1, 0, 0}, {20, 0.2, 10})
           .box({-1, 0, 0}, {1, 0.2, 4})
           .box({-1, 0, 6}, {1, 0.2, 10});
       maker.mesh(awkward::sphere(16, 0.6), awkward::translation({0, 4, 5}));
       for (int i = 1; i < 1000; ++i)
         maker.place(awkward::translation({-15 + 0.75 * (i % 40), 4.0 + i / 40, 1.0 + (i * 7 % 9)}));
       trial.model = maker.model();
       trial.build = {.part_triangles = 1024, .leaf_triangles = 1024, .hlod_triangles = 128};
       for (int i = 0; i < 8; ++i) trial.views.push_back(look({1.2 * i - 4, -5, 5}, {0, 3, 5}));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
