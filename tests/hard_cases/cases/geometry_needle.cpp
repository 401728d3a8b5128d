#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery geometry_needle(
    {.name = "geometry_needle",
     .group = "geometry",
     .breaks = "A needle of a million to one: its boxes are all length.",
     .faults = {},
     .make = [] {
       Trial trial;
       Maker maker;
       for (int i = 0; i < 8; ++i) {
         const double z = 0.3 * i;
         maker.mesh({"needle",
                     {{-500, z, z}, {500, z + 0.5, z}, {500, z + 0.5 + 1e-3, z}, {-500, z, z + 1e-3}},
                     {{{0, 1, 2}, 0}, {{0, 2, 3}, 0}, {{0, 1, 3}, 0}}});
       }
       maker.clutter(30, {-4, -4, -4}, {4, 4, 4}, 1, 20);
       trial.model = maker.model();
       trial.build.leaf_triangles = 4;
       trial.views = around({0, 0, 0}, 9, 4);
       trial.views.push_back(look({-520, -1, 2}, {0, 0, 0}, 3));
       trial.views.push_back(look({-499, 0.001, 0.001}, {500, 0.5, 0}, 40));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
