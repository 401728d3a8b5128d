#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery views_one_column(
    {.name = "views_one_column",
     .group = "views",
     .breaks = "A picture of 8192 pixels in one column, through a slit of a frustum.",
     .faults = {},
     .make = [] {
       Trial trial;
       trial.model = small_house();
       trial.views = house_views({1, 8192});
       trial.views.resize(5);
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
