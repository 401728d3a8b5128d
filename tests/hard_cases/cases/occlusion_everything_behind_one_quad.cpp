#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery occlusion_everything_behind_one_quad(
    {.name = "occlusion_everything_behind_one_quad",
     .group = "occlusion",
     .breaks = "One quad hides the whole scene; then the eye steps aside.",
     .faults = {"carried-hidden"},
     .make = [] {
       Trial trial;
       trial.model = Maker()
                         .quad({-10, 0, -10}, {20, 0, 0}, {0, 0, 20})
                         .clutter(120, {-4, 1, -4}, {4, 8, 4}, 1, 18)
                         .model();
       trial.build.leaf_triangles = 12;
       for (int i = 0; i < 4; ++i) trial.views.push_back(look({0.2 * i, -3, 0}, {0, 4, 0}));
       for (int i = 0; i < 6; ++i) trial.views.push_back(look({12.0 + i, -1, 0}, {0, 4, 0}));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
