#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery depth_near_plane_of_a_trillionth(
    {.name = "depth_near_plane_of_a_trillionth",
     .group = "depth",
     .breaks = "A near plane a trillionth of the scene away leaves nearly every depth at nearly zero.",
     .faults = {"strict-depth-test+no-dilation"},
     .make = [] {
       Trial trial;
       trial.model = small_house();
       for (View view : house_views()) {
         view.camera.near = 1e-12;
         trial.views.push_back(view);
       }
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
