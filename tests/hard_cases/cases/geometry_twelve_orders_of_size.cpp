#include "tests/hard_cases/maker.hpp"

#include <cmath>

namespace triptych::hard_cases {
namespace {

const InGallery geometry_twelve_orders_of_size(
    {.name = "geometry_twelve_orders_of_size",
     .group = "geometry",
     .breaks = "From a millionth to a million units: the small is below the lattice that the large asks for.",
     .faults = {"uncounted-lattice"},
     .make = [] {
       Trial trial;
       Maker maker;
       for (int i = -6; i <= 6; ++i) {
         const double size = std::pow(10.0, i);
         maker.mesh(awkward::sphere(6, size, {3 * size, 0, 0}));
       }
       trial.model = maker.model();
       for (int i = -5; i <= 6; ++i) {
         const double size = std::pow(10.0, i);
         trial.views.push_back(look({-size, -size, size}, {3 * size, 0, 0}, 60, {}, 1e-3 * size));
       }
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
