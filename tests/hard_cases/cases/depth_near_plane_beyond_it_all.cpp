#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery depth_near_plane_beyond_it_all(
    {.name = "depth_near_plane_beyond_it_all",
     .group = "depth",
     .breaks = "The near plane lies behind most of the scene: what it cuts away must neither hide anything "
               "nor be missed.",
     .faults = {},
     .make = [] {
       Trial trial;
       trial.model = small_house();
       for (int i = 0; i < 6; ++i)
         trial.views.push_back(look({-2, 3, 1.5}, {12, 4, 1.5}, 50, {}, 2 + 2.3 * i));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
