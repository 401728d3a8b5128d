#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery views_orthographic(
    {.name = "views_orthographic",
     .group = "views",
     .breaks = "Without perspective depth is linear, and deviations are as large far away as near by.",
     .faults = {"perspective-rule"},
     .make = [] {
       Trial trial;
       Maker maker;
       maker.clutter(120, {-6, -6, -3}, {6, 6, 3}, 1.5, 10);
       for (int i = 0; i < 6; ++i)
         maker.mesh(awkward::sphere(12, 0.8), awkward::translation({2.0 * i - 5, 0, 2}));
       trial.model = maker.model();
       for (int i = 0; i < 8; ++i) trial.views.push_back(look_parallel({-9, 0.5 * i, 6}, {0, 0, 0}, 12 - i));
       for (int i = 0; i < 4; ++i)
         trial.views.push_back(look_parallel({0, 0, 9}, {0, 0, 0}, 13, {97, 65}, 0.01, {0, 1, 0}));
       for (View& view : trial.views) view.width = 96, view.height = 72;
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
