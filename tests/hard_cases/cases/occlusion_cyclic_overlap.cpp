#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery occlusion_cyclic_overlap(
    {.name = "occlusion_cyclic_overlap",
     .group = "occlusion",
     .breaks = "Three beams, each before the next: no order from front to back exists.",
     .faults = {},
     .make = [] {
       Trial trial;
       Maker maker;
       for (int ring = 0; ring < 5; ++ring) {
         const double y = 3 * ring;
         maker.mesh({"beam",
                     {{0, y, 1}, {6, y + 1, 1}, {6, y + 1, 1.6}, {0, y, 1.6}},
                     {{{0, 1, 2}, 0}, {{0, 2, 3}, 0}}});
         maker.mesh({"beam",
                     {{5, y, 0}, {3, y + 1, 5}, {3.6, y + 1, 5}, {5.6, y, 0}},
                     {{{0, 1, 2}, 0}, {{0, 2, 3}, 0}}});
         maker.mesh({"beam",
                     {{4, y, 5}, {1, y + 1, 0}, {1.6, y + 1, 0}, {4.6, y, 5}},
                     {{{0, 1, 2}, 0}, {{0, 2, 3}, 0}}});
       }
       trial.model = maker.model();
       trial.build.leaf_triangles = 2;
       for (int i = 0; i < 8; ++i) trial.views.push_back(look({1.0 * i - 1, -6, 2.5}, {3, 0, 2.5}));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
