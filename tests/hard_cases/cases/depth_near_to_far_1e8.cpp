#include "tests/hard_cases/maker.hpp"

#include <cmath>

namespace triptych::hard_cases {
namespace {

const InGallery depth_near_to_far_1e8(
    {.name = "depth_near_to_far_1e8",
     .group = "depth",
     .breaks = "Between a near plane of 1e-4 and things at 1e4 lie eight orders of magnitude of depth.",
     .faults = {},
     .make = [] {
       Trial trial;
       Maker maker;
       for (int i = -4; i <= 4; ++i) {
         const double at = std::pow(10.0, i);
         maker.box({at, -0.45 * at, -0.3 * at}, {1.3 * at, 0.05 * at, 0.1 * at});
         maker.box({1.4 * at, -0.2 * at, -0.2 * at}, {1.5 * at, 0.4 * at, 0.3 * at});
       }
       trial.model = maker.model();
       trial.build.leaf_triangles = 12;
       for (int i = 0; i < 8; ++i)
         trial.views.push_back(look({0, 0.00002 * i, 0}, {1, 0.02 * i, 0}, 70, {}, 1e-4));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
