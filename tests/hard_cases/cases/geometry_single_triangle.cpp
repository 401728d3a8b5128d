#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery geometry_single_triangle(
    {.name = "geometry_single_triangle",
     .group = "geometry",
     .breaks = "The smallest model that there is: the root is a leaf, and its box is a triangle.",
     .faults = {},
     .make = [] {
       Trial trial;
       trial.model = scenes::make("triangle");
       trial.views = around({0.3, 0.3, 0.1}, 2, 6);
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
