#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery views_one_to_a_hundred(
    {.name = "views_one_to_a_hundred",
     .group = "views",
     .breaks = "A picture a hundred times as high as it is wide has pixels of two sizes of tangent only if "
               "the aspect is forgotten.",
     .faults = {},
     .make = [] {
       Trial trial;
       trial.model = small_house();
       trial.views = house_views({8, 800});
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
