#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery depth_decal(
    {.name = "depth_decal",
     .group = "depth",
     .breaks =
         "A decal a micrometre before a wall of ten metres is nearer by less than single precision can say.",
     .faults = {},
     .make = [] {
       Trial trial;
       Maker maker;
       maker.box({0, 0, 0}, {10, 0.2, 10});
       for (int i = 0; i < 25; ++i)
         maker.quad({0.5 + 2 * (i % 5), -1e-6, 0.5 + 2 * (i / 5)}, {1, 0, 0}, {0, 0, 1});
       trial.model = maker.model();
       trial.build.leaf_triangles = 12;
       for (int i = 0; i < 6; ++i) trial.views.push_back(look({5, -2.0 - 3 * i, 5}, {5 + 0.3 * i, 0, 5}));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
