#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery far_eye(
    {.name = "far_eye",
     .group = "far",
     .breaks = "From a thousand million units away, through a long lens, a float cannot tell the corners of "
               "a box apart.",
     .faults = {},
     .make = [] {
       Trial trial;
       trial.thin = true;
       trial.model = small_house();
       for (int i = 0; i < 6; ++i) {
         const glm::dvec3 from = glm::normalize(glm::dvec3(1, 0.2 * i - 0.5, 0.7));
         trial.views.push_back(look(glm::dvec3(8, 4, 1.5) + from * 1e9, {8, 4, 1.5}, 1e-6, {}, 1e6));
       }
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
