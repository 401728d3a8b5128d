#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery occlusion_pinholes(
    {.name = "occlusion_pinholes",
     .group = "occlusion",
     .breaks = "Holes of about a pixel in a wall show single pixels of what is behind.",
     .faults = {"withheld-id", "wrong-ancestor"},
     .make = [] {
       Trial trial;
       Maker maker;
       Mesh wall{"wall", {}, {}};
       for (int y = 0; y < 12; ++y) {
         for (int x = 0; x < 12; ++x)
           awkward::append(wall, awkward::box({x, 0, y}, {x + 0.93, 0.1, y + 0.93}));
       }
       maker.mesh(wall);
       maker.clutter(150, {0, 2, 0}, {12, 9, 12}, 0.4, 14);
       trial.model = maker.model();
       trial.build.leaf_triangles = 12;
       for (int i = 0; i < 8; ++i)
         trial.views.push_back(look({5 + 0.4 * i, -9 - 0.3 * i, 6}, {6, 0, 6}, 60, {128, 128}));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
