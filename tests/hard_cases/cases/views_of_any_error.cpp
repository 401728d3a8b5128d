#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery views_of_any_error(
    {.name = "views_of_any_error",
     .group = "views",
     .breaks = "A pixel error of a thousand million: the root will do, from wherever it is seen.",
     .faults = {},
     .make = [] {
       Trial trial;
       trial.model = small_house();
       trial.views = house_views();
       trial.pixel_error = 1e9;
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
