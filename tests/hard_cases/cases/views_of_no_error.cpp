#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery views_of_no_error(
    {.name = "views_of_no_error",
     .group = "views",
     .breaks = "A pixel error of a thousand millionth: nothing but the finest will do.",
     .faults = {},
     .make = [] {
       Trial trial;
       trial.model =
           Maker().mesh(awkward::sphere(16, 1)).clutter(30, glm::dvec3(-3), glm::dvec3(3), 1).model();
       trial.views = around(glm::dvec3(0), 6, 4);
       trial.pixel_error = 1e-9;
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
