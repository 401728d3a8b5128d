#include "tests/hard_cases/maker.hpp"

#include <cmath>
#include <limits>

namespace triptych::hard_cases {
namespace {

const InGallery geometry_non_finite_placements(
    {.name = "geometry_non_finite_placements",
     .group = "geometry",
     .breaks = "Placements that are not finite are left out, counted, and disturb nothing else.",
     .faults = {},
     .make = [] {
       Trial trial;
       Maker maker;
       maker.mesh(awkward::sphere(6, 1));
       const double infinite = std::numeric_limits<double>::infinity();
       maker.place(linear({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {infinite, 0, 0}));
       maker.place(linear({std::nan(""), 0, 0}, {0, 1, 0}, {0, 0, 1}));
       maker.place(linear({1e200, 0, 0}, {0, 1, 0}, {0, 0, 1}));
       maker.place(awkward::translation({3, 0, 0}));
       trial.model = maker.model();
       trial.left_out = 3;
       trial.views = around({1, 0, 0}, 6, 4);
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
