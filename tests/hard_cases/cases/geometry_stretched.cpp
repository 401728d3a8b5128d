#include "tests/hard_cases/maker.hpp"

#include <cmath>

namespace triptych::hard_cases {
namespace {

const InGallery geometry_stretched(
    {.name = "geometry_stretched",
     .group = "geometry",
     .breaks = "Placed at thirty times its size, a mesh deviates by thirty times its error.",
     .faults = {"dropped-singular-value"},
     .make = [] {
       Trial trial;
       Maker maker;
       maker.mesh(awkward::sphere(14, 1));
       for (int i = 1; i < 8; ++i) {
         const double angle = 0.7 * i;
         maker.place(linear({30 * std::cos(angle), 30 * std::sin(angle), 0},
                            {-2 * std::sin(angle), 2 * std::cos(angle), 0}, {0, 0, 0.5 * i},
                            {70.0 * (i % 3), 70.0 * (i / 3), 0}));
       }
       trial.model = maker.model();
       trial.views = around({70, 70, 0}, 200, 6, 60, {}, 1);
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
