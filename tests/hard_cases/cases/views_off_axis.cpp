#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery views_off_axis(
    {.name = "views_off_axis",
     .group = "views",
     .breaks = "A frustum wholly to one side of the view direction.",
     .faults = {"dropped-stretch"},
     .make = [] {
       Trial trial;
       Maker maker;
       maker.clutter(60, {0, -8, -3}, {20, 12, 6}, 1.2, 9);
       for (int i = 0; i < 8; ++i)
         maker.mesh(awkward::sphere(10, 0.7), awkward::translation({5.0 + i, 4.0 + i, 0.4 * i}));
       trial.model = maker.model();
       for (int i = 0; i < 8; ++i) {
         View view = look({-1.0 * i, 0, 1}, {10, 0, 1}, 60, {160, 120});
         view.camera.left = -2.5;
         view.camera.right = -0.4 - 0.1 * i;
         view.camera.bottom = 0.05 * i - 0.3;
         view.camera.top = 0.9;
         trial.views.push_back(view);
       }
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
