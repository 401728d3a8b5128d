#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery views_orthographic_inside(
    {.name = "views_orthographic_inside",
     .group = "views",
     .breaks = "An orthographic eye inside the scene: its near plane cuts boxes of every size.",
     .faults = {"strict-depth-test+no-dilation"},
     .make = [] {
       Trial trial;
       trial.model = scenes::make("coplanar");
       for (int i = 0; i < 8; ++i) trial.views.push_back(look_parallel({3, 0.5 * i + 0.5, 2}, {3, 9, 2}, 5));
       for (int i = 0; i < 8; ++i)
         trial.views.push_back(look_parallel({3, 0.5 * i + 0.5, 2}, {4, 9, 1}, 5, {}, 0.5));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
