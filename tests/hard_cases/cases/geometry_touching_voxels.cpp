#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery geometry_touching_voxels(
    {.name = "geometry_touching_voxels",
     .group = "geometry",
     .breaks = "Cubes that share every face with a neighbour: all that is inside is hidden exactly.",
     .faults = {"strict-depth-test+no-dilation"},
     .make = [] {
       Trial trial;
       Maker maker;
       for (int i = 0; i < 125; ++i)
         maker.box({i % 5, i / 5 % 5, i / 25}, {i % 5 + 1, i / 5 % 5 + 1, i / 25 + 1});
       trial.model = maker.model();
       trial.build.leaf_triangles = 12;
       trial.views = around({2.5, 2.5, 2.5}, 9, 6);
       trial.views.push_back(look({2.5, -6, 2.5}, {2.5, 0, 2.5}));
       trial.views.push_back(look({2.5, 2.5, 2.5}, {9, 2.5, 2.5}));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
