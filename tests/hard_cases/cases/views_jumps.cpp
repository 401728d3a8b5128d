#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery views_jumps(
    {.name = "views_jumps",
     .group = "views",
     .breaks = "From anywhere to anywhere: nothing of the last frame holds.",
     .faults = {"stale-camera", "carried-hidden", "withheld-id", "wrong-delta", "wrong-delta+no-digest"},
     .make = [] {
       Trial trial;
       trial.model = small_house();
       Random random(13);
       for (int i = 0; i < 16; ++i) {
         const glm::dvec3 eye = glm::dvec3(16, 8, 3) * random.vector();
         trial.views.push_back(look(eye, glm::dvec3(16, 8, 3) * random.vector(), 30 + 20 * (i % 5)));
       }
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
