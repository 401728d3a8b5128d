#include "tests/hard_cases/maker.hpp"

#include <cmath>

namespace triptych::hard_cases {
namespace {

const InGallery views_zoom(
    {.name = "views_zoom",
     .group = "views",
     .breaks = "The field of view closes from 150 degrees to a twentieth of one: levels of detail run "
               "through their whole range.",
     .faults = {},
     .make = [] {
       Trial trial;
       Maker maker;
       for (int i = 0; i < 12; ++i)
         maker.mesh(awkward::sphere(12, 0.9), awkward::translation({2.0 * (i % 4), 2.0 * (i / 4), 0.3 * i}));
       trial.model = maker.model();
       trial.pixel_error = 2;
       for (int i = 0; i < 16; ++i)
         trial.views.push_back(look({-12, 3, 6}, {3, 2, 1}, 150 * std::exp2(-0.75 * i)));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
