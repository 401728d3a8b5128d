#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery boxes_flat_in_two_dimensions(
    {.name = "boxes_flat_in_two_dimensions",
     .group = "boxes",
     .breaks =
         "Needles as thin as the lattice: boxes that are next to lines, and cover a pixel here and there.",
     .faults = {},
     .make = [] {
       Trial trial;
       Maker maker;
       Random random(5);
       maker.box({-4, -4, -4}, {-3.5, 4, 4});
       for (int i = 0; i < 60; ++i) {
         const glm::dvec3 at = random.vector(-3, 3);
         glm::dvec3 along(0), aside(0);
         along[i % 3] = 3;
         aside[(i + 1) % 3] = 2e-7;
         maker.triangle(at, at + along, at + along + aside);
       }
       trial.model = maker.model();
       trial.build.leaf_triangles = 1;
       trial.views = around({0, 0, 0}, 9, 6);
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
