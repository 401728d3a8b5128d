#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery geometry_instances_of_instances(
    {.name = "geometry_instances_of_instances",
     .group = "geometry",
     .breaks =
         "Groups that are placed in groups turn and stretch what is in them twice: bounds must grow, boxes "
         "hold and triangles stay turned out on all of the way.",
     .faults = {"unflipped-mirror", "dropped-singular-value"},
     .make = [] {
       Trial trial;
       Maker maker;
       maker.mesh(awkward::sphere(8, 0.9));
       for (int i = 1; i < 6; ++i) maker.place(linear({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2.0 * i, 0, 0}));
       maker.mesh(awkward::box({-1, 1.25, -0.5}, {11, 1.5, 0.75}));
       const uint32_t row = maker.group();
       maker.mesh(awkward::box({-1, -1.5, -1.25}, {11, 4, -1}));
       maker.place_group(row, Affine(1));
       maker.place_group(row, linear({-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {10, 3, 0}));
       const uint32_t floor = maker.group();
       maker.place_group(floor, linear({-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {10, 0, 0}));
       maker.place_group(floor, linear({-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {10, 0, 3}));
       maker.place_group(floor, linear({0, 3, 0}, {-3, 0, 0}, {0, 0, -3}, {-8, 0, 4}));
       maker.place_group(floor, linear({2, 2, 0}, {-1, 1, 0}, {0, 0, 4}, {24, 0, 2}));
       maker.place_group(row, linear({-6, 0, 0}, {0, 1, 0}, {0, 0, 1}, {30, -8, 0}));
       trial.model = maker.model();
       trial.oriented = true;
       trial.build.hlod_triangles = 900;
       trial.pixel_error = 3;
       trial.views = around({8, 4, 4}, 50, 6);
       trial.views.push_back(look({160, 20, 60}, {8, 4, 4}));
       trial.views.push_back(look({4, 1.5, 1.5}, {20, 2, 1}));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
